#include "experiments/campaign/plan/budget_use.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/plan/cores.h"

namespace talus::campaign {
namespace {

bool HasEnded(const journal::TrialRecord& trial) {
  return trial.status != journal::TrialStatus::kRunning;
}

// Duration of an ended trial [s]; 0 where it is not known.
double Duration(const journal::TrialRecord& trial) {
  return std::isfinite(trial.duration_s) ? std::max(0.0, trial.duration_s) : 0;
}

// Duration of a trial of the experiment at the scale factor [s]: the mean of those that have ended,
// else from the nearest scale factor that some have ended at, as the cost goes with f⁻⁴. Another
// experiment's where this one has none; 0 where no trial has ended.
double TimeOfOne(std::span<const journal::TrialRecord> trials, int experiment, double factor) {
  double sum = 0, count = 0;
  double nearest = std::numeric_limits<double>::infinity();  // |ln(f / factor)|
  for (const bool own : {true, false}) {
    for (const journal::TrialRecord& trial : trials) {
      if (!HasEnded(trial) || (own && trial.experiment != experiment)) continue;
      if (trial.kind == journal::TrialKind::kReused) continue;  // of another machine, it may be
      if (Duration(trial) == 0) continue;                       // found after a kill
      const double away = std::abs(std::log(trial.scale_factor / factor));
      if (away > nearest) continue;
      if (away < nearest) sum = count = 0;
      nearest = away;
      sum += Duration(trial) * std::pow(trial.scale_factor / factor, 4);
      count += 1;
    }
    if (count > 0) break;
  }
  return count > 0 ? sum / count : 0;
}

// What so many trials of this duration take at most [s]: the last may run alone.
double Rounds(double count, double each, int at_a_time) {
  return std::ceil(std::max(0.0, count) / at_a_time) * each;
}

// What the trials so far say of the pace.
struct Pace {
  std::span<const journal::TrialRecord> trials;
  int num_experiments;
  int num_ended;   // of the search, one at least
  double elapsed;  // [s]
  int at_a_time;

  // Wall time of so many further trials of the search at most [s]: all may be at the finest scale
  // factor, and of the dearest experiment. Proposals and pauses stay as they were.
  double Of(double count, double finest) const {
    double durations = 0, dearest = 0;
    for (const journal::TrialRecord& trial : trials) {
      if (HasEnded(trial) && trial.IsPaidFor()) durations += Duration(trial);
    }
    for (int e = 0; e < num_experiments; ++e) {
      dearest = std::max(dearest, TimeOfOne(trials, e, finest));
    }
    const double beside = std::max(0.0, elapsed - durations / at_a_time) / num_ended;
    return std::max(0.0, count) * beside + Rounds(count, dearest, at_a_time);
  }
};

// By whichever part of the budget ends the search first [s].
double SearchLeft(const CampaignSpec& spec, const BudgetUse& use, const Pace& pace) {
  const BudgetOptions& budget = spec.budget;
  double left = std::numeric_limits<double>::infinity();
  if (budget.simulations > 0) {
    left = pace.Of(budget.simulations - pace.num_ended, spec.coarse_graining.Levels().back());
  }
  if (budget.core_time && use.core_seconds > 0) {
    left = std::min(left, pace.elapsed * (*budget.core_time - use.core_seconds) / use.core_seconds);
  }
  if (budget.wall_clock) left = std::min(left, *budget.wall_clock - pace.elapsed);
  return std::max(0.0, left);
}

// The recommended set, branches and ends of every experiment [s]; `begun` are the confirming trials
// since the search ended.
double ConfirmationLeft(const CampaignSpec& spec, const Pace& pace,
                        std::span<const journal::TrialRecord> begun) {
  const double factor = spec.ConfirmScaleFactor();
  double sum = 0;
  double rounds = 0;
  double dearest = 0;
  for (int e = 0; e < pace.num_experiments; ++e) {
    const auto ended = std::ranges::count_if(begun, [&](const journal::TrialRecord& trial) {
      return trial.experiment == e && HasEnded(trial);
    });
    const double count = spec.confirm.MostTrials() - static_cast<double>(ended);
    if (count <= 0) continue;
    const double each = TimeOfOne(pace.trials, e, factor);
    sum += count * each;
    rounds += Rounds(count, each, pace.at_a_time);
    dearest = std::max(dearest, each);
  }
  // One experiment after the other, or whichever is next while a worker is free (Graham's bound).
  return std::min(rounds, dearest + (sum - dearest) / pace.at_a_time);
}

}  // namespace

double AfterwardsLeft(const CampaignSpec& spec, double core_time, int at_a_time) {
  const bool advises =
      spec.engine.kind == EngineKind::kTalus && spec.runner.kind == RunnerKind::kLocal;
  const double share = (advises ? spec.next.share : 0) + spec.budget.sensitivity_share;
  return share * core_time / at_a_time;
}

BudgetUse UseOf(const CampaignSpec& spec, std::span<const journal::TrialRecord> trials,
                double elapsed, int at_a_time, double goal_time) {
  BudgetUse use{.core_seconds = goal_time};
  int search_ended = 0;
  for (const journal::TrialRecord& trial : trials) {
    if (!trial.IsOfSearch()) {
      ++use.num_confirm;
      continue;
    }
    use.num_confirm = 0;  // a search that goes on is confirmed anew
    if (!trial.IsPaidFor()) continue;
    ++use.num_search;
    if (!HasEnded(trial)) continue;
    ++search_ended;
    use.core_seconds += MeasuredCoreTime(trial, spec);
  }
  if (spec.budget.core_time) {
    use.core_seconds = std::min(use.core_seconds, *spec.budget.core_time);
  }
  if (search_ended == 0) return use;
  const Pace pace{.trials = trials,
                  .num_experiments = static_cast<int>(ExperimentsOf(spec).size()),
                  .num_ended = search_ended,
                  .elapsed = elapsed,
                  .at_a_time = std::max(1, at_a_time)};
  const double search = use.num_confirm > 0 ? 0 : SearchLeft(spec, use, pace);
  if (!std::isfinite(search)) return use;
  const double work =
      search + ConfirmationLeft(spec, pace, trials.last(static_cast<std::size_t>(use.num_confirm)));
  const double core_time =
      use.core_seconds + work * pace.at_a_time * CoresOfTrial(spec);  // when that is done
  use.seconds_left = work + AfterwardsLeft(spec, core_time, pace.at_a_time);
  return use;
}

std::string UseText(const BudgetOptions& budget, const BudgetUse& use, double elapsed) {
  std::string text = budget.simulations > 0 ? std::to_string(use.num_search) + " of " +
                                                  base::Counted(budget.simulations, "simulation")
                                            : base::Counted(use.num_search, "simulation");
  if (budget.core_time) {
    text += ", " + base::DurationText(use.core_seconds) + " of " +
            base::DurationText(*budget.core_time) + " core time";
  }
  if (budget.wall_clock) {
    text += ", " + base::DurationText(std::min(elapsed, *budget.wall_clock)) + " of " +
            base::DurationText(*budget.wall_clock);
  }
  return text;
}

}  // namespace talus::campaign
