// `talus simulate` for a case of another engine.
#pragma once

#include <filesystem>

#include "experiments/trials/engines/command_case.h"

namespace talus::trials {

struct CommandFolderOptions {
  std::filesystem::path folder;    // new, empty, or the same case's
  bool fresh = false;              // run again where it is complete, or where it is another case's
  bool quiet = false;              // nothing on standard output
  std::filesystem::path source{};  // the user's file, if there is one
};

// The whole trial. Throws ConfigError for a folder with anything else, before anything is written,
// and base::Error with the reason when the trial fails or another process simulates there.
void SimulateCommandCase(const CommandCase& command_case, const CommandFolderOptions& options);

}  // namespace talus::trials
