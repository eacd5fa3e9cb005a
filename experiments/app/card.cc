// talus card
#include "experiments/analysis/card/card.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "experiments/app/commands.h"

namespace talus::app {

void AddCardCommand(CLI::App& app) {
  struct Arguments {
    std::string input;
    std::string format = "table";
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "card", "The calibrated set as lines for another DEM code, its conventions converted");
  command->add_option("DIR", arguments->input, "folder of a finished campaign, or a case.json")
      ->required();
  std::vector<std::string> formats;
  for (const auto& [name, format] : base::Names<analysis::CardFormat>::kList)
    formats.emplace_back(name);
  command->add_option("--format", arguments->format, "whose lines")
      ->check(CLI::IsMember(formats))
      ->capture_default_str();
  command->callback([arguments] {
    for (const auto& [name, format] : base::Names<analysis::CardFormat>::kList) {
      if (arguments->format == name)
        std::cout << analysis::CardText(analysis::ReadCard(arguments->input), format);
    }
  });
}

}  // namespace talus::app
