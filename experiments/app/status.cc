// talus status
#include "experiments/campaign/status.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "experiments/app/commands.h"

namespace talus::app {

void AddStatusCommand(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("status", "Where a campaign stands; also while it runs");
  command->add_option("DIR", *folder, "the campaign's folder")->required();
  command->callback([folder] { std::cout << campaign::StatusText(*folder) << std::flush; });
}

}  // namespace talus::app
