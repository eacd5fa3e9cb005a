// What `calibrate`, `resume` and `compare --objective` share: work on a campaign until its end.
#pragma once

#include <filesystem>

#include "experiments/campaign/folder/console.h"
#include "experiments/campaign/start.h"

namespace CLI {
class App;
}

namespace talus::app {

// How much a verb that works on a campaign tells: --quiet and --json.
struct TellOptions {
  bool quiet = false;
  bool json = false;
  campaign::Console::Output output() const;
};
void AddTellFlags(CLI::App& command, TellOptions& tell);

// Prints the result. Throws base::Interrupted when the user ends it, base::Error without a result.
void GoOn(const std::filesystem::path& folder, const campaign::ResumeOptions& options,
          const TellOptions& tell);

}  // namespace talus::app
