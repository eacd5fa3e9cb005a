// talus sensitivity
#include "experiments/analysis/sensitivity/sensitivity.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/analysis/sensitivity/moved_trials.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "experiments/app/command_line.h"
#include "experiments/app/commands.h"
#include "experiments/campaign/make_parts.h"

namespace talus::app {
namespace {

struct SensitivityArguments {
  std::string folder;
  std::vector<std::string> moves;
  std::optional<double> scale_factor;
  int most_replicates = 16;
  std::string budget;
  bool json = false;
};

std::vector<std::pair<std::string, std::string>> ReadMoves(const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> moves;
  for (const std::string& text : texts) {
    auto move = ReadAssignment(text, "restitution=0.6");
    if (std::ranges::find(moves, move) != moves.end()) {
      throw base::ConfigError(text + ": is given twice");
    }
    moves.push_back(std::move(move));
  }
  return moves;
}

void Sensitivity(const SensitivityArguments& arguments) {
  const campaign::JointView view = campaign::ReadJointView(arguments.folder);
  auto moves = ReadMoves(arguments.moves);
  const std::filesystem::path folder = analysis::SensitivityFolder(view.folder.root);
  analysis::SensitivityOptions options{
      .moves = std::move(moves),
      .scale_factor = arguments.scale_factor,
      .most_replicates = arguments.most_replicates,
      .parts = campaign::MakeParts(view.spec, folder),
      .tell = [](const std::string& line) { std::cerr << line << std::endl; }};
  if (!arguments.budget.empty()) {
    options.core_time = BudgetTime(arguments.budget);
  }
  const analysis::SensitivityTable table = analysis::FindSensitivity(view, options);
  analysis::WriteSensitivity(table, view.folder.root);
  std::cout << (arguments.json ? base::JsonText(base::ToJson(table), 2) + "\n"
                               : analysis::SensitivityText(table))
            << std::flush;
}

}  // namespace

void AddSensitivityCommand(CLI::App& app) {
  auto arguments = std::make_shared<SensitivityArguments>();
  CLI::App* command = app.add_subcommand(
      "sensitivity", "What the answer owes to what was held fixed, such as restitution");
  command->add_option("DIR", arguments->folder, "the campaign's folder")->required();
  command->add_option(
      "MOVES", arguments->moves,
      "NAME=VALUE of fixed parameters, as restitution=0.6; default: what is usually "
      "known poorly");
  command->add_option("--scale-factor", arguments->scale_factor,
                      "of its simulations, one of the campaign's; default: the coarsest");
  command
      ->add_option("--replicates", arguments->most_replicates,
                   "simulations of each experiment at most, where fewer do not tell; default: " +
                       std::to_string(arguments->most_replicates))
      ->check(CLI::Range(analysis::kFirstReplicates, 1000));
  command->add_option(
      "--budget", arguments->budget,
      "core time for its simulations, such as \"5 min\"; the first of each thing moved are made "
      "whatever they take; default: as they need");
  command->add_flag("--json", arguments->json, "as JSON");
  command->callback([arguments] { Sensitivity(*arguments); });
}

}  // namespace talus::app
