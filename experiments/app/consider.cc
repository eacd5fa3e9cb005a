// talus consider
#include "experiments/campaign/consider.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "experiments/app/commands.h"

namespace talus::app {
namespace {

struct Arguments {
  std::string folder;
  std::vector<std::string> set;
  bool json = false;
};

std::map<std::string, std::string> ReadSet(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> set;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
      throw base::ConfigError("\"" + text + "\": must be NAME=VALUE, as sliding_friction=0.45");
    }
    if (!set.emplace(text.substr(0, equals), text.substr(equals + 1)).second) {
      throw base::ConfigError(text.substr(0, equals) + ": is given twice");
    }
  }
  return set;
}

void Consider(const Arguments& arguments) {
  const campaign::ConsideredSet considered =
      campaign::ConsiderSet(arguments.folder, ReadSet(arguments.set));
  std::cout << (arguments.json ? campaign::ConsideredJson(considered)
                               : campaign::ConsideredText(considered))
            << std::flush;
}

}  // namespace

void AddConsiderCommand(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "consider", "Where a given parameter set stands in what a campaign's trials say");
  command->add_option("DIR", arguments->folder, "the campaign's folder; it may be running")
      ->required();
  command->add_option("SET", arguments->set, "NAME=VALUE of every calibrated parameter")
      ->required();
  command->add_flag("--json", arguments->json, "as JSON");
  command->callback([arguments] { Consider(*arguments); });
}

}  // namespace talus::app
