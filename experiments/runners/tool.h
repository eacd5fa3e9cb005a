// Runs a short-lived command of the system (squeue, sbatch) and returns what it prints.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace talus::runners {

struct ToolResult {
  int status = 0;      // exit status; 127 when it cannot be run, 128 + n when ended by signal n
  std::string output;  // standard output
  std::string errors;  // standard error
  bool started = true;

  bool ok() const { return status == 0; }
};

struct ToolOptions {
  double time_cap = 60;  // [s], after which it is killed: a queue that does not answer
  // Where standard output goes instead of `output`: it is then there even if we are killed first.
  std::filesystem::path output_file{};
  std::string input{};  // what it reads from its standard input; below 64 KiB
  // By which a ProcessGuard ends it with us; "": it goes on, as sbatch must.
  std::string mark{};
  std::size_t most_output = std::size_t{64} << 20;  // [bytes], after which it is killed
  // Asked several times a second: whether to kill it now.
  std::function<bool()> is_stopped = [] { return false; };
};

// Returns when the command has ended, whatever it has left running. `command[0]` is looked up on
// the PATH. Throws base::Error only when the system has no process left.
ToolResult RunTool(const std::vector<std::string>& command, const ToolOptions& options = {});

// Where a program is: from `folder` on if its name has a "/", else on the PATH; empty when it is
// not there, or not executable.
std::filesystem::path FindProgram(const std::string& program, const std::filesystem::path& folder);

}  // namespace talus::runners
