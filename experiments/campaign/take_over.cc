#include "experiments/campaign/take_over.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/text/counted.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/campaign/start.h"
#include "experiments/journal/journal.h"

namespace talus::campaign {
namespace {

// What the next trial of the search is called.
struct Numbers {
  std::int64_t id = 1;
  std::int64_t kind_index = 0;
  std::int64_t set = 1;  // 0 is the noise's
  double due = 0;        // after all that was told before
};

Numbers NextOf(const std::vector<journal::TrialRecord>& trials) {
  Numbers next;
  for (const journal::TrialRecord& trial : trials) {
    next.id = std::max(next.id, trial.id + 1);
    next.due = std::max(next.due, trial.due);
    if (!trial.IsOfSearch()) continue;
    next.set = std::max(next.set, trial.set + 1);
    if (trial.kind == journal::TrialKind::kDesign || trial.kind == journal::TrialKind::kSearch) {
      ++next.kind_index;
    }
  }
  return next;
}

}  // namespace

bool SearchesTheSame(const CampaignSpec& spec, const FormerTest& test) {
  return std::ranges::equal(SearchedParameters(spec), test.parameters, {},
                            &journal::ParameterRecord::name, &journal::ParameterRecord::name);
}

std::optional<std::vector<double>> UnitOf(const CampaignSpec& spec, const FormerTest& test,
                                          const FormerTrial& former) {
  constexpr double kRounding = 1e-12;
  const optimizer::ParameterSpace space = SpaceOf(spec);
  std::vector<double> values =
      space.ToNative(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(former.native.size())));
  std::vector<double> unit;
  for (const int i : space.Free()) {
    const double value = former.native[unit.size()];
    const double u = space.parameters[static_cast<std::size_t>(i)].ToUnit(value);
    if (!(u >= -kRounding && u <= 1 + kRounding)) return std::nullopt;
    unit.push_back(std::clamp(u, 0.0, 1.0));
    values[static_cast<std::size_t>(i)] = value;
  }
  if (!space.Satisfies(values)) return std::nullopt;
  return test.parameters == SearchedParameters(spec) ? former.unit : unit;
}

journal::TrialRecord TrialOf(const NewExperiment& experiment, const FormerTrial& former,
                             std::vector<double> unit) {
  journal::TrialRecord trial;
  trial.objective = base::NameOf(experiment.spec.objective);
  trial.unit = std::move(unit);
  trial.native = former.native;
  trial.seed = former.seed;
  trial.experiment = experiment.index;
  trial.scale_factor = former.scale_factor;
  trial.started_utc = journal::UtcNow();
  trial.duration_s = former.duration_s;
  trial.cpu_s = former.cpu_s;
  return trial;
}

bool TakeOver(const CampaignFolder& folder, const NewExperiment& experiment,
              const FormerTrial& former, const journal::TrialRecord& trial,
              trials::TrialEngine& engine, TakenOver& taken) {
  if (!engine.IsComplete(former.folder)) return false;
  const rigs::Case rig_case = CaseOfTrial(experiment.spec, trial, experiment.reference.frame());
  const std::filesystem::path to = folder.trial(trial.id);
  try {
    if (!engine.TakeOver(rig_case, former.folder, to)) return false;
    taken.core_time += engine.Collect(rig_case, to).cpu_time;
  } catch (const base::Error&) {
    std::filesystem::remove_all(to);
    return false;
  }
  KeepTrial(folder, trial);
  taken.trials.push_back(trial);
  return true;
}

TakenOver TakeOverDesigns(const CampaignFolder& folder,
                          const std::vector<journal::TrialRecord>& trials,
                          const NewExperiment& experiment, trials::TrialEngine& engine) {
  TakenOver taken;
  Numbers numbers = NextOf(trials);
  const std::vector<double> levels = experiment.spec.coarse_graining.Levels();
  for (const DesignFolder& design : DesignsOf(folder.root)) {
    const FormerTest test = FormerTestOf(design);
    // One of fewer parameters was made before another was searched, too.
    if (!SearchesTheSame(experiment.spec, test)) continue;
    for (const FormerTrial& former : test.trials) {
      const auto unit = UnitOf(experiment.spec, test, former);
      if (!unit || std::ranges::count(levels, former.scale_factor) == 0) continue;
      journal::TrialRecord trial = TrialOf(experiment, former, *unit);
      trial.id = numbers.id;
      trial.due = numbers.due;
      trial.kind = journal::TrialKind::kDesign;
      trial.kind_index = numbers.kind_index;
      trial.set = numbers.set;
      trial.origin = journal::kOriginNext;
      if (!TakeOver(folder, experiment, former, trial, engine, taken)) continue;
      ++numbers.id;
      ++numbers.kind_index;
      ++numbers.set;
    }
    if (!taken.trials.empty()) break;  // one design of the test is enough
  }
  return taken;
}

std::string TakenOverText(const TakenOver& taken) {
  const auto count = static_cast<long long>(taken.trials.size());
  return base::Counted(count, "simulation") + " that `talus next` had made of it " +
         (count == 1 ? "is" : "are") + " taken over";
}

}  // namespace talus::campaign
