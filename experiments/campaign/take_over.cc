#include "experiments/campaign/take_over.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/journal/journal.h"

namespace talus::campaign {
namespace {

// What the next trial of the search is called.
struct Numbers {
  std::int64_t id = 1;
  std::int64_t kind_index = 0;
  std::int64_t set = 1;  // 0 is the noise's
};

Numbers NextOf(const std::vector<journal::TrialRecord>& trials) {
  Numbers next;
  for (const journal::TrialRecord& trial : trials) {
    next.id = std::max(next.id, trial.id + 1);
    if (trial.kind == journal::TrialKind::kConfirm) continue;
    next.set = std::max(next.set, trial.set + 1);
    if (trial.kind != journal::TrialKind::kNoise) ++next.kind_index;
  }
  return next;
}

rigs::Case CaseOfTrial(const NewExperiment& experiment, const journal::TrialRecord& trial) {
  const optimizer::ParameterSpace space = SpaceOf(experiment.spec);
  const Eigen::VectorXd point = Eigen::Map<const Eigen::VectorXd>(
      trial.unit.data(), static_cast<Eigen::Index>(trial.unit.size()));
  return CaseOf(experiment.spec,
                {.values = space.ToNative(point),
                 .seed = static_cast<std::uint64_t>(trial.seed),
                 .scale_factor = trial.scale_factor,
                 .experiment = experiment.index},
                experiment.reference.frame());
}

journal::TrialRecord Made(const NewExperiment& experiment, const DesignRecord& design,
                          std::size_t index, const Numbers& numbers) {
  const optimizer::ParameterSpace space = SpaceOf(experiment.spec);
  journal::TrialRecord trial;
  trial.id = numbers.id;
  trial.kind = journal::TrialKind::kDesign;
  trial.kind_index = numbers.kind_index;
  trial.set = numbers.set;
  trial.origin = "design";
  trial.objective = base::NameOf(experiment.spec.objective);
  trial.unit = design.points[index];
  const std::vector<double> values = space.ToNative(Eigen::Map<const Eigen::VectorXd>(
      trial.unit.data(), static_cast<Eigen::Index>(trial.unit.size())));
  for (const int i : space.Free()) trial.native.push_back(values[static_cast<std::size_t>(i)]);
  trial.seed = static_cast<std::int64_t>(DesignSeed(experiment.spec.seed, index));
  trial.experiment = experiment.index;
  trial.scale_factor = design.scale_factor;
  trial.started_utc = journal::UtcNow();
  return trial;
}

// Its core time; nothing where it is not complete, of another test or has failed.
std::optional<double> TakeOver(const NewExperiment& experiment, const journal::TrialRecord& trial,
                               const std::filesystem::path& from, const std::filesystem::path& to,
                               trials::TrialEngine& engine) {
  if (!engine.IsComplete(from)) return std::nullopt;
  const rigs::Case rig_case = CaseOfTrial(experiment, trial);
  try {
    if (!engine.TakeOver(rig_case, from, to)) return std::nullopt;
    return engine.Collect(rig_case, to).cpu_time;
  } catch (const base::Error&) {
    std::filesystem::remove_all(to);
    return std::nullopt;
  }
}

}  // namespace

TakenOver TakeOverDesigns(const CampaignFolder& folder,
                          const std::vector<journal::TrialRecord>& trials,
                          const NewExperiment& experiment, trials::TrialEngine& engine) {
  TakenOver taken;
  Numbers numbers = NextOf(trials);
  const std::vector<double> levels = experiment.spec.coarse_graining.Levels();
  const std::size_t num_free = SpaceOf(experiment.spec).Free().size();
  for (const DesignFolder& design : DesignsOf(folder.root)) {
    const auto record = design.Read();
    if (!record || std::count(levels.begin(), levels.end(), record->scale_factor) == 0) continue;
    // One of fewer parameters was made before another was searched, too.
    if (record->points.empty() || record->points.front().size() != num_free) continue;
    for (std::size_t i = 0; i < record->points.size(); ++i) {
      const journal::TrialRecord trial = Made(experiment, *record, i, numbers);
      const auto core_time =
          TakeOver(experiment, trial, design.trial(i), folder.trial(trial.id), engine);
      if (!core_time) continue;
      KeepTrial(folder, trial);
      taken.trials.push_back(trial);
      taken.core_time += *core_time;
      ++numbers.id;
      ++numbers.kind_index;
      ++numbers.set;
    }
    if (!taken.trials.empty()) break;  // one design of the test is enough
  }
  return taken;
}

std::string TakenOverText(const TakenOver& taken) {
  return std::to_string(taken.trials.size()) +
         " simulations that `talus next` had made of it are taken over";
}

}  // namespace talus::campaign
