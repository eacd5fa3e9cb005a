#include "experiments/analysis/sensitivity/moved_trials.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/campaign/plan/campaign_strategy.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/record/trial_end.h"
#include "experiments/campaign/run_cases.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/trials/simulate/work_text.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

std::string FolderName(const MovedSet& set) {
  std::string name = set.move == nullptr ? "as recommended" : set.move->name + " " + set.move->to;
  if (set.point) {
    name += " at";
    for (const double x : *set.point) name += " " + base::ShortNumber(x, 6);
  }
  return base::FileWord(name);
}

fs::path FolderOf(const SensitivitySetting& setting, const MovedSet& set, int experiment,
                  int replicate) {
  return SensitivityFolder(setting.view.folder.root) / FolderName(set) /
         ("experiment_" + std::to_string(experiment + 1)) / base::FileNumber(replicate + 1);
}

// Calls `body` for every experiment that a set is simulated for.
template <class Body>
void ForEachExperiment(const SensitivitySetting& setting, const std::vector<MovedSet>& sets,
                       Body&& body) {
  for (const MovedSet& set : sets) {
    const Move* acting = set.move != nullptr ? set.move : set.beside;
    for (const int e : setting.view.Answered()) {
      if (acting == nullptr || ActsOn(setting, *acting, e)) body(set, e);
    }
  }
}

Simulated ReadSimulated(const SensitivitySetting& setting, const MovedSet& set, int experiment,
                        int replicate) {
  const campaign::Reference& reference =
      setting.view.references[static_cast<std::size_t>(experiment)];
  const Eigen::VectorXd point = set.point.value_or(setting.point);
  const campaign::CaseOutcome outcome =
      campaign::OutcomeOf({.folder = FolderOf(setting, set, experiment, replicate),
                           .rig_case = MovedCase(setting, set, experiment, replicate)},
                          *setting.parts.engine);
  journal::TrialRecord trial;
  trial.unit = {point.begin(), point.end()};
  trial.experiment = experiment;
  trial.scale_factor = setting.scale_factor;
  trial.status = journal::TrialStatus::kFailed;
  trial.cpu_s = outcome.core_time;
  std::vector<float> field;
  try {
    if (!outcome.output) throw base::Error("did not end well");
    if (reference.has_image()) field = reference.Field(outcome.output->profile);
    campaign::TakeOutput(*outcome.output, reference, trial);
  } catch (const base::Error&) {
    // It says nothing of the shift; the table counts it.
  }
  return {.observation = campaign::ObservationOf(trial, reference, std::move(field)),
          .has_ended = trial.status == journal::TrialStatus::kOk,
          .core_time = trial.cpu_s};
}

}  // namespace

fs::path SensitivityFolder(const fs::path& campaign) {
  return fs::absolute(campaign) / "sensitivity";
}

rigs::Case MovedCase(const SensitivitySetting& setting, const MovedSet& set, int experiment,
                     int replicate) {
  const campaign::JointView& view = setting.view;
  rigs::Case rig_case = campaign::CaseOf(
      view.spec,
      {.values = view.space.ToNative(set.point.value_or(setting.point)),
       .seed = campaign::DesignSeed(view.spec.seed, static_cast<std::size_t>(replicate)),
       .scale_factor = setting.scale_factor,
       .experiment = experiment},
      view.references[static_cast<std::size_t>(experiment)].frame());
  if (set.move != nullptr) set.move->apply(rig_case);
  return rig_case;
}

bool ActsOn(const SensitivitySetting& setting, const Move& move, int experiment) {
  return !rigs::IsSameRun(MovedCase(setting, {}, experiment, 0),
                          MovedCase(setting, {.move = &move}, experiment, 0));
}

double CoreTimeOf(const SensitivitySetting& setting, const std::vector<MovedSet>& sets) {
  campaign::CoreTime core_time(setting.view.spec);
  core_time.Of(setting.view.trials);
  double seconds = 0;
  ForEachExperiment(setting, sets, [&](const MovedSet& set, int e) {
    seconds += set.replicates * core_time.OfOne(e, setting.scale_factor);
  });
  return seconds;
}

std::string WorkText(const SensitivitySetting& setting, const std::vector<MovedSet>& sets) {
  int count = 0;
  ForEachExperiment(setting, sets, [&](const MovedSet& set, int) { count += set.replicates; });
  return trials::WorkText(count, "simulation", CoreTimeOf(setting, sets));
}

void RunMoved(const SensitivitySetting& setting, const std::vector<MovedSet>& sets) {
  std::vector<campaign::FolderCase> cases;
  ForEachExperiment(setting, sets, [&](const MovedSet& set, int e) {
    for (int i = 0; i < set.replicates; ++i) {
      cases.push_back(
          {.folder = FolderOf(setting, set, e, i), .rig_case = MovedCase(setting, set, e, i)});
    }
  });
  const campaign::CaseRuns runs{.spec = setting.view.spec,
                                .count = cases.size(),
                                .at = [&](std::size_t i) { return cases[i]; }};
  if (campaign::RunCases(runs, setting.parts)) return;
  throw base::Interrupted("interrupted; the same command goes on with the sensitivity");
}

SimulatedSet ReadSet(const SensitivitySetting& setting, const MovedSet& set) {
  const std::vector<int> answered = setting.view.Answered();
  SimulatedSet simulated(answered.size());
  ForEachExperiment(setting, {set}, [&](const MovedSet&, int e) {
    const auto at = std::ranges::find(answered, e) - answered.begin();
    for (int i = 0; i < set.replicates; ++i) {
      Simulated one = ReadSimulated(setting, set, e, i);
      one.observation.experiment = static_cast<int>(at);
      simulated[static_cast<std::size_t>(at)].push_back(std::move(one));
    }
  });
  return simulated;
}

void Tally::Add(const SimulatedSet& set) {
  for (const std::vector<Simulated>& experiment : set) {
    for (const Simulated& one : experiment) {
      ++num_simulations;
      num_failed += one.has_ended ? 0 : 1;
      core_time += one.core_time;
    }
  }
}

}  // namespace talus::analysis
