#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "base/file.h"
#include "experiments/cli/commands.h"
#include "experiments/compare/compare_tables.h"
#include "experiments/compare/gather_evidence.h"
#include "experiments/compare/profile_pictures.h"

namespace talus::experiments {
namespace {

struct Arguments {
  std::filesystem::path campaign;
  std::filesystem::path out;
};

void WriteComparison(const ComparedCampaign& compared, const std::filesystem::path& out) {
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw base::Error(out.string() + ": cannot be made: " + error.message());
  const auto shown = TrialsToShow(compared.evidence, compared.findings);
  std::vector<Picture> pictures = ProfilePictures(compared.evidence, shown);
  pictures.push_back(SideBySide(compared.evidence, shown));
  for (const Picture& picture : pictures) {
    if (picture.png.empty()) continue;
    base::WriteFileAtomically(out / (picture.name + ".png"), picture.png);
  }
  base::WriteFileAtomically(out / "objectives.csv", ObjectivesCsv(compared));
  base::WriteFileAtomically(out / "ten_best.csv", TenBestCsv(compared));
  base::WriteFileAtomically(out / "compare.json", ComparisonJson(compared));
  base::WriteFileAtomically(out / "compare.txt", ComparisonText(compared));
}

void RunCompare(const Arguments& arguments) {
  const std::filesystem::path out =
      arguments.out.empty() ? arguments.campaign / "compare" : arguments.out;
  const Evidence evidence = GatherEvidence(arguments.campaign);
  const std::vector<ObjectiveFinding> findings = CompareObjectives(evidence);
  const ComparedCampaign compared{evidence, findings};
  WriteComparison(compared, out);
  std::cout << ComparisonText(compared) << "  Tables and pictures are in " << out.string() << '\n';
}

}  // namespace

void AddCompareCommand(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Which set each objective prefers, and how unique its answer is");
  command->add_option("DIR", arguments->campaign, "folder of the campaign; it may be running")
      ->required();
  command->add_option("--out", arguments->out, "folder to write into; default: DIR/compare");
  command->callback([arguments] { RunCompare(*arguments); });
}

}  // namespace talus::experiments
