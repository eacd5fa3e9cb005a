#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/interrupt.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/report/write_report.h"
#include "experiments/analysis/search/search_folder.h"
#include "experiments/analysis/search/search_page.h"
#include "experiments/app/commands.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/status.h"

namespace talus::app {
namespace {

constexpr int kWatchPeriod = 5;  // between two looks at the campaign [s]

struct ReportArguments {
  std::filesystem::path campaign;
  std::filesystem::path out;
  std::string experiment;
  bool watch = false;
};

// What a newer page would show: nothing is written while it stays the same.
std::string StateOf(const analysis::Evidence& evidence) {
  std::string state(base::NameOf(evidence.state));
  if (evidence.ended_silently) state += campaign::kEndedSilently;
  for (const analysis::TrialEvidence* trial : evidence.AllTrials()) {
    state += base::NameOf(trial->state).front();
  }
  return state;
}

// Once of each, however often the page is written.
void WarnOf(const analysis::LeftOut& left_out, analysis::LeftOut& said) {
  for (const std::string& line : left_out) {
    if (std::ranges::find(said, line) != said.end()) continue;
    std::cerr << "warning: left out of the report: " << line << std::endl;
    said.push_back(line);
  }
}

// With the model that answers, and the campaign's other experiments.
analysis::ReportData Complete(const ReportArguments& arguments, analysis::Evidence evidence,
                              analysis::LeftOut& said) {
  std::vector<analysis::Evidence> others = analysis::GatherOthers(arguments.campaign, evidence);
  analysis::AddModel(arguments.campaign, evidence, others);
  analysis::ReportData data = analysis::MakeReportData(std::move(evidence), std::move(others));
  WarnOf(data.left_out, said);
  return data;
}

// Keeps the page current until the campaign stands still or the user ends it.
void Watch(const ReportArguments& arguments) {
  const base::InterruptGuard interrupt;
  std::string shown;
  std::vector<analysis::RegionPoint> history;
  analysis::LeftOut said;
  std::optional<analysis::ReportData> data;
  while (interrupt.Asked() == base::Interrupt::kNone) {
    // Asked before the journal is read: what was written last is still shown.
    const bool worked_on = campaign::IsWorkedOn(arguments.campaign);
    analysis::Evidence evidence =
        analysis::GatherEvidence(arguments.campaign, arguments.experiment);
    const std::string state = StateOf(evidence) + (worked_on ? "+" : "-");
    if (state != shown) {
      data = Complete(arguments, std::move(evidence), said);
      analysis::Follow(*data, history);
      data->region_history = history;
      const auto page =
          analysis::WriteReport(*data, arguments.out, {.reload = worked_on ? kWatchPeriod : 0});
      if (shown.empty()) std::cout << "The report is " << page.string() << std::endl;
      shown = state;
    }
    if (!worked_on) return;
    for (int i = 0; i < 10 * kWatchPeriod && interrupt.Asked() == base::Interrupt::kNone; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  // Nobody keeps the page current any more: it must not load itself anew, and with it lose its
  // reader's place.
  if (data) analysis::WriteReport(*data, arguments.out, {.reload = 0});
}

void ReportSearch(const ReportArguments& arguments) {
  if (arguments.watch || !arguments.experiment.empty()) {
    throw base::ConfigError(arguments.campaign.string() +
                            ": is the folder of a search by `talus optimize`; --watch and "
                            "--experiment are for campaigns");
  }
  const auto page =
      analysis::WriteSearchReport(analysis::ReadSearchFolder(arguments.campaign), arguments.out);
  std::cout << "The report is " << page.string() << '\n';
}

}  // namespace

void AddReportCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report",
                                         "Write the report of a campaign or a search: one HTML "
                                         "page, with its figures and tables beside it");
  command
      ->add_option("DIR", arguments->campaign,
                   "folder of a campaign, or of a search by `talus optimize`; it may be running")
      ->required();
  command->add_option("--out", arguments->out, "folder to write into; default: DIR/report");
  command->add_flag("--watch", arguments->watch,
                    "write it anew whenever a trial ends, until the campaign does; the open page "
                    "follows by itself");
  command->add_option(
      "--experiment", arguments->experiment,
      "that stands first, in a campaign with several; default: the first with images");
  command->callback([arguments] {
    if (arguments->out.empty()) arguments->out = arguments->campaign / "report";
    if (analysis::IsSearchFolder(arguments->campaign)) {
      ReportSearch(*arguments);
      return;
    }
    if (arguments->watch) {
      Watch(*arguments);
      return;
    }
    analysis::Evidence evidence =
        analysis::GatherEvidence(arguments->campaign, arguments->experiment);
    analysis::LeftOut said;
    const auto page =
        analysis::WriteReport(Complete(*arguments, std::move(evidence), said), arguments->out);
    std::cout << "The report is " << page.string() << '\n';
  });
}

}  // namespace talus::app
