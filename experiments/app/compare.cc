// talus compare
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "experiments/analysis/compare/compare_tables.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/app/commands.h"
#include "experiments/app/go_on.h"

namespace talus::app {
namespace {

struct CompareArguments {
  std::string campaign;
  std::filesystem::path out;
  std::string objective;
  std::string experiment;
  int add_simulations = 20;
};

void SearchOn(const CompareArguments& arguments) {
  for (const auto& [name, objective] : base::Names<journal::Objective>::kList) {
    if (name != arguments.objective) continue;
    GoOn(arguments.campaign, {.add_simulations = arguments.add_simulations, .objective = objective},
         {});
    return;
  }
}

void WriteComparison(const analysis::ComparedCampaign& compared, const std::filesystem::path& out) {
  const auto shown = analysis::TrialsToShow(compared.evidence, compared.findings);
  std::vector<analysis::Picture> pictures = analysis::ProfilePictures(compared.evidence, shown);
  pictures.push_back(analysis::SideBySide(compared.evidence, shown));
  for (const analysis::Picture& picture : pictures) {
    if (picture.png.empty()) continue;
    base::WriteFileAtomically(out / (picture.name + ".png"), picture.png);
  }
  base::WriteFileAtomically(out / "objectives.csv", analysis::ObjectivesCsv(compared));
  base::WriteFileAtomically(out / "ten_best.csv", analysis::TenBestCsv(compared));
  base::WriteFileAtomically(out / "compare.json", analysis::ComparisonJson(compared));
}

void RunCompare(CompareArguments arguments) {
  if (!arguments.objective.empty()) SearchOn(arguments);
  if (arguments.out.empty()) arguments.out = std::filesystem::path(arguments.campaign) / "compare";
  analysis::Evidence evidence = analysis::GatherEvidence(arguments.campaign, arguments.experiment);
  analysis::AddModel(arguments.campaign, evidence);
  const std::vector<analysis::ObjectiveFinding> findings = analysis::CompareObjectives(evidence);
  const analysis::ComparedCampaign compared{evidence, findings};
  base::ClaimOutputFolder(arguments.out, "compare");
  WriteComparison(compared, arguments.out);
  const std::string text = analysis::ComparisonText(compared) + "\n";
  base::WriteFileAtomically(arguments.out / "compare.txt", text);
  std::cout << text << "  Tables and pictures are in " << arguments.out.string() << '\n';
}

}  // namespace

void AddCompareCommand(CLI::App& app) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Which set each objective prefers, and how unique its answer is");
  command->add_option("DIR", arguments->campaign, "folder of the campaign; it may be running")
      ->required();
  command->add_option("--out", arguments->out, "folder to write into; default: DIR/compare");
  std::vector<std::string> objectives;
  for (const auto& [name, objective] : base::Names<journal::Objective>::kList)
    objectives.emplace_back(name);
  CLI::Option* objective =
      command
          ->add_option("--objective", arguments->objective,
                       "first search on by this objective, from all the trials there are")
          ->check(CLI::IsMember(objectives));
  command
      ->add_option("--add-simulations", arguments->add_simulations,
                   "so many more for --objective; default: 20")
      ->check(CLI::Range(1, campaign::BudgetOptions::kMostSimulations))
      ->needs(objective);
  command->add_option("--experiment", arguments->experiment,
                      "whose trials are compared, in a campaign with several; default: the first");
  command->callback([arguments] { RunCompare(*arguments); });
}

}  // namespace talus::app
