// talus compare
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/shell_text.h"
#include "experiments/analysis/batches/batches_text.h"
#include "experiments/analysis/compare/compare_tables.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/app/command_line.h"
#include "experiments/app/commands.h"
#include "experiments/app/go_on.h"
#include "experiments/journal/journal.h"

namespace talus::app {
namespace {

struct CompareArguments {
  std::vector<std::string> folders;
  std::string campaign;  // the only one of these
  std::vector<std::string> matters;
  std::filesystem::path out;
  std::string objective;
  std::string experiment;
  int add_simulations = 20;
};

// An objective is of an image: of numbers alone every one of them searches the same way.
void RequireImages(const std::filesystem::path& folder) {
  const journal::CampaignRecord record =
      journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign();
  const auto has_image = [](const journal::ExperimentRecord& e) { return !e.aehp_png.empty(); };
  if (std::ranges::any_of(record.experiments, has_image)) return;
  throw base::ConfigError("--objective: is of an image, and " + folder.string() +
                          " has numbers only, which are met by their errors; `talus resume " +
                          base::ShellWord(folder.string()) + " --add-simulations N` searches on");
}

void SearchOn(const CompareArguments& arguments) {
  GoOn(arguments.campaign,
       {.add_simulations = arguments.add_simulations,
        .objective = base::EnumNamed<journal::Objective>(arguments.objective)},
       {});
}

void WriteComparison(const analysis::ComparedCampaign& compared, const std::filesystem::path& out) {
  const auto shown = analysis::TrialsToShow(compared.evidence, compared.findings);
  std::vector<analysis::Picture> pictures = analysis::ProfilePictures(compared.evidence, shown);
  pictures.push_back(analysis::SideBySide(compared.evidence, shown));
  for (const char* former : {"anhp_trial_", "signed_map_trial_", "aehp", "side_by_side"}) {
    base::RemoveFormerFiles(out, former);
  }
  for (const analysis::Picture& picture : pictures) {
    if (picture.png.empty()) continue;
    base::WriteFileAtomically(out / (picture.name + ".png"), picture.png);
  }
  base::WriteFileAtomically(out / "objectives.csv", analysis::ObjectivesCsv(compared));
  base::WriteFileAtomically(out / "ten_best.csv", analysis::TenBestCsv(compared));
  base::WriteFileAtomically(out / "compare.json", analysis::ComparisonJson(compared));
}

void RunBatches(const CompareArguments& arguments) {
  if (!arguments.objective.empty() || !arguments.experiment.empty()) {
    throw base::ConfigError("--objective and --experiment are of one campaign; " +
                            std::to_string(arguments.folders.size()) +
                            " folders are compared as batches of a powder");
  }
  const analysis::BatchComparison comparison = analysis::CompareBatches(
      {arguments.folders.begin(), arguments.folders.end()}, ReadSetArgument(arguments.matters));
  const std::filesystem::path& out = arguments.out;
  if (!out.empty()) {
    base::ClaimOutputFolder(out, "compare");
    base::RemoveFormerFiles(out, "batches_");
    base::WriteFileAtomically(out / "batches.html", analysis::BatchesPage(comparison));
    base::WriteFileAtomically(out / "batches.csv", analysis::BatchesCsv(comparison));
    base::WriteFileAtomically(out / "batches.json",
                              base::JsonText(base::ToJson(comparison), 2) + "\n");
    for (const analysis::BatchParameter& parameter : comparison.parameters) {
      base::WriteFileAtomically(out / ("batches_" + parameter.name + ".svg"),
                                analysis::BatchesSvg(comparison, parameter));
    }
  }
  std::cout << analysis::BatchesText(comparison);
  if (!out.empty()) std::cout << "  Tables and charts are in " << out.string() << '\n';
}

void RunCompare(CompareArguments arguments) {
  if (arguments.folders.size() > 1) return RunBatches(arguments);
  if (!arguments.matters.empty()) {
    throw base::ConfigError("--matters: is for batches; give the folders of two campaigns or more");
  }
  arguments.campaign = arguments.folders.front();
  if (!arguments.objective.empty()) RequireImages(arguments.campaign);
  if (arguments.out.empty()) arguments.out = std::filesystem::path(arguments.campaign) / "compare";
  analysis::Evidence evidence = analysis::GatherEvidence(arguments.campaign, arguments.experiment);
  base::ClaimOutputFolder(arguments.out, "compare");
  if (!arguments.objective.empty()) {
    SearchOn(arguments);  // now that nothing else can be wrong
    evidence = analysis::GatherEvidence(arguments.campaign, arguments.experiment);
  }
  analysis::AddModel(arguments.campaign, evidence);
  const std::vector<analysis::ObjectiveFinding> findings = analysis::CompareObjectives(evidence);
  const analysis::ComparedCampaign compared{evidence, findings};
  WriteComparison(compared, arguments.out);
  const std::string text = analysis::ComparisonText(compared) + "\n";
  base::WriteFileAtomically(arguments.out / "compare.txt", text);
  std::cout << text << "  Tables and pictures are in " << arguments.out.string() << '\n';
}

}  // namespace

void AddCompareCommand(CLI::App& app) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Which set each objective prefers; or whether batches of a powder differ");
  command
      ->add_option("DIR", arguments->folders,
                   "folder of the campaign; several are compared as batches with the first")
      ->required();
  command->add_option("--out", arguments->out,
                      "folder to write into; default: DIR/compare, and of batches none");
  command->add_option("--matters", arguments->matters,
                      "of batches, NAME=VALUE: a difference of this parameter that would matter, "
                      "a factor of a logarithmic one; default: a tenth of its searched range");
  CLI::Option* objective =
      command
          ->add_option(
              "--objective", arguments->objective,
              "first run further simulations, and answer by this objective from all trials")
          ->check(CLI::IsMember(base::NamesOf<journal::Objective>()));
  command
      ->add_option("--add-simulations", arguments->add_simulations,
                   "so many more for --objective; default: 20")
      ->check(CLI::Range(1, campaign::BudgetOptions::kMostSimulations))
      ->needs(objective);
  command->add_option(
      "--experiment", arguments->experiment,
      "whose trials are compared, in a campaign with several; default: the first with "
      "photographs, else the first");
  command->callback([arguments] { RunCompare(*arguments); });
}

}  // namespace talus::app
