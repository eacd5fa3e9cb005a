#include "experiments/campaign/former_trials.h"

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/journal/journal.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

double IfKnown(double seconds) { return std::isfinite(seconds) ? seconds : 0; }

std::vector<FormerTest> TestsOfCampaign(const fs::path& root) {
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(root));
  const journal::CampaignRecord record = journal.Campaign();
  const CampaignFolder folder{fs::absolute(root)};
  std::vector<FormerTest> tests;
  for (const journal::ExperimentRecord& experiment : record.experiments) {
    tests.push_back({.name = experiment.name, .parameters = record.parameters});
  }
  for (const journal::TrialRecord& trial : journal.Trials()) {
    FormerTest& test = tests.at(static_cast<std::size_t>(trial.experiment));
    test.num_failed += trial.status == journal::TrialStatus::kFailed;
    if (trial.status != journal::TrialStatus::kOk) continue;
    test.trials.push_back({.folder = folder.trial(trial.id),
                           .unit = trial.unit,
                           .native = trial.native,
                           .seed = trial.seed,
                           .scale_factor = trial.scale_factor,
                           .duration_s = IfKnown(trial.duration_s),
                           .cpu_s = IfKnown(trial.cpu_s)});
  }
  return tests;
}

}  // namespace

FormerTest FormerTestOf(const DesignFolder& design) {
  FormerTest test{.name = design.root.filename().string()};
  const std::optional<DesignRecord> record = design.Read();
  if (!record) return test;
  test.parameters = record->parameters;
  for (std::size_t i = 0; i < record->points.size(); ++i) {
    FormerTrial trial{.folder = design.trial(i),
                      .unit = record->points[i],
                      .seed = static_cast<std::int64_t>(DesignSeed(record->seed, i)),
                      .scale_factor = record->scale_factor};
    if (trial.unit.size() != test.parameters.size()) continue;
    for (std::size_t k = 0; k < trial.unit.size(); ++k) {
      trial.native.push_back(SearchedParameter(test.parameters[k]).ToNative(trial.unit[k]));
    }
    test.trials.push_back(std::move(trial));
  }
  return test;
}

std::vector<FormerTest> FormerTestsIn(const fs::path& root) {
  std::vector<FormerTest> tests;
  const bool is_campaign = fs::exists(journal::JournalPath(root));
  if (is_campaign) tests = TestsOfCampaign(root);
  const std::vector<DesignFolder> designs = DesignsOf(root);
  if (!is_campaign && designs.empty()) {
    throw base::ConfigError(root.string() +
                            ": is neither the folder of a campaign nor one of `talus design`");
  }
  for (const DesignFolder& design : designs) tests.push_back(FormerTestOf(design));
  return tests;
}

}  // namespace talus::campaign
