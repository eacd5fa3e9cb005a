#include "experiments/campaign/plan/budget_use.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/trials/simulate/run_log.h"

namespace talus::campaign {
namespace {

bool HasEnded(const journal::TrialRecord& trial) {
  return trial.status != journal::TrialStatus::kRunning;
}

// Duration of an ended trial [s]; 0 where it is not known.
double Duration(const journal::TrialRecord& trial) {
  return std::isfinite(trial.duration_s) ? std::max(0.0, trial.duration_s) : 0;
}

// Duration of a trial that confirms, by those that have, else by those of the search that are as
// fine [s].
double ConfirmTime(const CampaignSpec& spec, std::span<const journal::TrialRecord> trials) {
  const double factor = spec.confirm.scale_factor.value_or(spec.coarse_graining.scale_factor);
  double sum = 0, count = 0, longest = 0;
  for (const journal::TrialRecord& trial : trials) {
    if (!HasEnded(trial)) continue;
    longest = std::max(longest, Duration(trial));
    if (trial.scale_factor != factor) continue;
    sum += Duration(trial);
    count += 1;
  }
  return count > 0 ? sum / count : longest;
}

// By whichever part of the budget ends the search first [s].
double SearchLeft(const CampaignSpec& spec, const BudgetUse& use, int num_ended, double elapsed) {
  const BudgetOptions& budget = spec.budget;
  double left = std::numeric_limits<double>::infinity();
  if (budget.simulations > 0 && num_ended > 0) {
    left = std::min(left, elapsed * (budget.simulations - num_ended) / num_ended);
  }
  if (budget.core_time && use.core_seconds > 0) {
    left = std::min(left, elapsed * (*budget.core_time - use.core_seconds) / use.core_seconds);
  }
  if (budget.wall_clock) left = std::min(left, *budget.wall_clock - elapsed);
  return std::max(0.0, left);
}

}  // namespace

BudgetUse UseOf(const CampaignSpec& spec, std::span<const journal::TrialRecord> trials,
                double elapsed, int at_a_time, double goal_time) {
  BudgetUse use{.core_seconds = goal_time};
  int search_ended = 0, confirm_ended = 0;
  for (const journal::TrialRecord& trial : trials) {
    if (!IsOfSearch(trial)) {
      ++use.num_confirm;
      confirm_ended += HasEnded(trial);
      continue;
    }
    if (!IsPaidFor(trial)) continue;
    ++use.num_search;
    if (!HasEnded(trial)) continue;
    ++search_ended;
    use.core_seconds += MeasuredCoreTime(trial, CoresOfTrial(spec));
  }
  if (spec.budget.core_time) {
    use.core_seconds = std::min(use.core_seconds, *spec.budget.core_time);
  }
  if (search_ended == 0) return use;
  const double search = use.num_confirm > 0 ? 0 : SearchLeft(spec, use, search_ended, elapsed);
  const int to_confirm =
      spec.confirm.MostTrials() * static_cast<int>(ExperimentsOf(spec).size()) - confirm_ended;
  const double confirm =
      std::max(0, to_confirm) * ConfirmTime(spec, trials) / std::max(1, at_a_time);
  if (std::isfinite(search)) use.seconds_left = search + confirm;
  return use;
}

std::string UseText(const BudgetOptions& budget, const BudgetUse& use, double elapsed) {
  std::string text = std::to_string(use.num_search) +
                     (budget.simulations > 0 ? " of " + std::to_string(budget.simulations) : "") +
                     " simulations";
  if (budget.core_time) {
    text += ", " + trials::DurationText(use.core_seconds) + " of " +
            trials::DurationText(*budget.core_time) + " core time";
  }
  if (budget.wall_clock) {
    text += ", " + trials::DurationText(std::min(elapsed, *budget.wall_clock)) + " of " +
            trials::DurationText(*budget.wall_clock);
  }
  return text;
}

}  // namespace talus::campaign
