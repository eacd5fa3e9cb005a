// talus card
#include "experiments/analysis/card/card.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/text/counted.h"
#include "experiments/app/commands.h"

namespace talus::app {
namespace {

struct CardArguments {
  std::filesystem::path input;
  std::string format;  // empty: a table, and of draws every one
  std::optional<int> draws;
  std::filesystem::path out;  // empty: DIR/cards
};

std::vector<analysis::CardFormat> FormatsOf(const std::string& wanted) {
  std::vector<analysis::CardFormat> formats;
  for (const auto& [name, format] : base::Names<analysis::CardFormat>::kList) {
    if (wanted.empty() || wanted == name) formats.push_back(format);
  }
  return formats;
}

void WriteCards(const CardArguments& arguments) {
  constexpr int kMost = 1000;
  if (!arguments.draws) {
    if (!arguments.out.empty()) {
      throw base::ConfigError("--out: is for the cards of --draws; one card is printed");
    }
    std::cout << analysis::CardText(
        analysis::ReadCard(arguments.input),
        FormatsOf(arguments.format.empty() ? "table" : arguments.format).front());
    return;
  }
  if (*arguments.draws < 2 || *arguments.draws > kMost) {
    throw base::ConfigError("--draws: is " + std::to_string(*arguments.draws) +
                            ", must be from 2 to 1000; without it the recommended set is printed");
  }
  if (!std::filesystem::is_directory(arguments.input)) {
    throw base::ConfigError(arguments.input.string() +
                            ": is no folder of a campaign; one case has no draws");
  }
  const std::filesystem::path out =
      arguments.out.empty() ? arguments.input / "cards" : arguments.out;
  const auto cards = analysis::ReadDrawCards(arguments.input, *arguments.draws);
  analysis::WriteDrawCards(cards, FormatsOf(arguments.format), out);
  std::cout << base::Counted(static_cast<long long>(cards.size()), "card") << " in " << out.string()
            << "; draws.csv has their weights\n";
}

}  // namespace

void AddCardCommand(CLI::App& app) {
  const auto arguments = std::make_shared<CardArguments>();
  CLI::App* command = app.add_subcommand(
      "card", "The calibrated set as lines for another DEM code, its conventions converted");
  command->add_option("DIR", arguments->input, "folder of a finished campaign, or a case.json")
      ->required();
  command
      ->add_option("--format", arguments->format,
                   "whose lines; default: table, and of draws every one")
      ->check(CLI::IsMember(base::NamesOf<analysis::CardFormat>()));
  command->add_option("--draws", arguments->draws,
                      "files with so many sets along the posterior, from 2 to 1000");
  command->add_option("--out", arguments->out, "folder for these; default: DIR/cards");
  command->callback([arguments] { WriteCards(*arguments); });
}

}  // namespace talus::app
