// Drives a run in its folder to the end: progress, checkpoints, interruption, results.
//
// A folder holds one input's run, by one process at a time. Its checkpoint is gone on from; its
// result is kept. What a run that begins anew finds of an earlier one goes; a film of a finished
// run leaves its result there until it has its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "engine/run/run.h"

namespace talus::trials {

struct RunJob {
  std::string kind;                // as result.json has it
  std::uint64_t input_hash = 0;    // of what the result depends on
  std::filesystem::path source;    // the user's file
  std::string input_name;          // of the complete input in the folder: "case.json"
  std::string input;               // its text
  double checkpoint_interval = 0;  // wall-clock [s]; 0: only when interrupted
  std::function<std::unique_ptr<engine::Run>()> start;
  std::function<std::unique_ptr<engine::Run>(const engine::RunCheckpoint&)> go_on;
  // Called at the start and after each slice.
  std::function<void(const engine::Run&)> look = [](const engine::Run&) {};
  // What is written besides, before the result says that all is there.
  std::function<void()> write = [] {};
  // What a run that goes on from a checkpoint lacks; empty if nothing.
  std::string lost_at_checkpoint{};
  // What it shows begins there: a result will not do, and a checkpoint is not given up for it.
  bool from_start = false;
};

struct RunFolderOptions {
  std::filesystem::path folder;
  bool fresh = false;  // begin anew, whatever the folder holds
  bool quiet = false;  // nothing on standard output
};

// Throws base::Interrupted after SIGINT or SIGTERM, when a checkpoint has been saved; base::Error
// when the run fails, which result.json then says, or another process simulates there;
// ConfigError before anything is written.
void DriveRun(const RunJob& job, const RunFolderOptions& options);

}  // namespace talus::trials
