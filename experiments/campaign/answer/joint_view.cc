#include "experiments/campaign/answer/joint_view.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/text/joined.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/journal/objective.h"

namespace talus::campaign {

CampaignSpec SpecOfAnswer(const journal::CampaignRecord& campaign,
                          const journal::ProgressRecord& progress) {
  CampaignSpec spec = ParseSpecText(campaign.spec_json);
  if (progress.result_json.empty()) return spec;
  const std::string of_result = ParseAnswer(progress.result_json).objective;
  for (const journal::ObjectiveInfo& info : journal::kObjectives) {
    if (of_result == info.ValueKey())
      spec.objective = *base::EnumNamed<journal::Objective>(info.key);
  }
  return spec;
}

int JointView::IndexOf(std::string_view name) const {
  const auto& all = record.experiments;
  const auto found = std::ranges::find(all, name, &journal::ExperimentRecord::name);
  if (found != all.end()) return static_cast<int>(found - all.begin());
  throw base::ConfigError("\"" + std::string(name) + "\": is no experiment of " +
                          folder.root.string() + "; it has \"" +
                          base::Joined(all, "\", \"", &journal::ExperimentRecord::name) + "\"");
}

std::vector<int> JointView::All() const {
  std::vector<int> all(references.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::int64_t JointView::LastEnded() const {
  std::int64_t last = 0;
  for (const journal::TrialRecord& trial : trials) {
    if (trial.status != journal::TrialStatus::kRunning) last = std::max(last, trial.id);
  }
  return last;
}

std::vector<int> JointView::Answered() const {
  std::vector<int> answered = All();
  if (spec.hold_out) std::erase(answered, IndexOf(*spec.hold_out));
  return answered;
}

void JointView::Observe(
    const std::function<std::vector<float>(const journal::TrialRecord&)>& field) {
  for (const journal::TrialRecord& trial : InOrderOfFinish(trials)) {
    if (!trial.IsOfSearch()) continue;
    observations.push_back(
        ObservationOf(trial, references[static_cast<std::size_t>(trial.experiment)], field(trial)));
  }
}

JointView ReadJointView(const std::filesystem::path& root) {
  const CampaignFolder folder{root};
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder.root));
  journal::CampaignRecord record = journal.Campaign();
  const CampaignSpec spec = SpecOfAnswer(record, journal.Progress());
  JointView view{.folder = folder,
                 .spec = spec,
                 .record = std::move(record),
                 .references = {},
                 .space = SpaceOf(spec),
                 .trials = journal.Trials()};
  view.references = ReferencesOf(view.record, spec);
  view.Observe([&](const journal::TrialRecord& trial) {
    return StoredField(journal, folder, view.references, trial);
  });
  return view;
}

std::unique_ptr<optimizer::PosteriorStrategy> StrategyOf(const JointView& view,
                                                         const std::vector<int>& experiments) {
  const std::vector<optimizer::ExperimentTarget> all =
      TargetsOf(view.spec, view.record, view.references);
  std::vector<optimizer::ExperimentTarget> targets;
  for (const int e : experiments) targets.push_back(all[static_cast<std::size_t>(e)]);
  auto strategy = MakePosteriorStrategyFor(view.spec, std::move(targets));
  for (optimizer::Observation observation : view.observations) {
    const auto at = std::find(experiments.begin(), experiments.end(), observation.experiment);
    if (at == experiments.end()) continue;
    observation.experiment = static_cast<int>(at - experiments.begin());
    strategy->Tell(observation);
  }
  return strategy;
}

std::unique_ptr<optimizer::PosteriorStrategy> AnsweringStrategy(const JointView& view) {
  auto strategy = StrategyOf(view, view.Answered());
  if (strategy->CanModel()) return strategy;
  throw base::Error(view.folder.root.string() +
                    ": has too few trials of each experiment for a posterior; go on with `talus "
                    "resume " +
                    base::ShellWord(view.folder.root.string()) +
                    "`, and --add-simulations 20 where it has ended");
}

PartialAnswer AnswerOf(const JointView& view, optimizer::PosteriorStrategy& strategy,
                       const std::vector<int>& experiments) {
  PartialAnswer partial;
  for (const int e : experiments) {
    partial.experiments.push_back(view.NameOf(e));
  }
  const optimizer::Answer answer = strategy.Recommend();
  if (!answer.posterior) {
    throw base::Error("too few trials of \"" + partial.experiments.front() +
                      "\" for an answer by itself");
  }
  partial.point = answer.point;
  partial.values = FreeValues(view.space, answer.point);
  FreeRanges ranges = CredibleValues(view.space, answer);
  partial.low = std::move(ranges.low);
  partial.high = std::move(ranges.high);
  partial.region_volume = answer.posterior->region_volume;
  return partial;
}

}  // namespace talus::campaign
