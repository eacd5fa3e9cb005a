#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/report/write_report.h"
#include "experiments/app/commands.h"

namespace talus::experiments {

void AddReportCommand(CLI::App& app) {
  struct Arguments {
    std::filesystem::path campaign;
    std::filesystem::path out;
    std::string experiment;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Write a campaign's report: one HTML page, with its figures and tables beside it");
  command->add_option("DIR", arguments->campaign, "folder of the campaign; it may be running")
      ->required();
  command->add_option("--out", arguments->out, "folder to write into; default: DIR/report");
  command->add_option("--experiment", arguments->experiment,
                      "whose trials are shown, in a campaign with several; default: the first");
  command->callback([arguments] {
    const std::filesystem::path out =
        arguments->out.empty() ? arguments->campaign / "report" : arguments->out;
    const auto page = WriteReport(
        MakeReportData(GatherEvidence(arguments->campaign, arguments->experiment)), out);
    std::cout << "The report is " << page.string() << '\n';
  });
}

}  // namespace talus::experiments
