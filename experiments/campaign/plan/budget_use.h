// How much of its budget a campaign has used, and how long it will still take at most: by what its
// trials took, its own pauses and proposals counted, with the confirmation, the ends among it, and
// with what follows by itself.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

struct BudgetUse {
  int num_search = 0;       // trials of noise and search that were started, no reused ones
  int num_confirm = 0;      // … of the confirmation, since the search ended
  double core_seconds = 0;  // of those of the search that have ended, and of the goal's runs; not
                            // more than the budget [s]
  std::optional<double> seconds_left{};  // at most; none before a trial has ended
};

// `elapsed`: that the campaign was worked on [s]; `at_a_time`: trials that run side by side, >= 1;
// `goal_time`: processor time of the runs for its goal [s].
BudgetUse UseOf(const CampaignSpec& spec, std::span<const journal::TrialRecord> trials,
                double elapsed, int at_a_time, double goal_time = 0);

// Wall time of what follows the answer by itself, at most: further tests and sensitivity [s].
// `core_time`: of the search, the goal's runs and the confirmation [s].
double AfterwardsLeft(const CampaignSpec& spec, double core_time, int at_a_time);

// "21 of 60 simulations, 12 s of 25 s core time, 1 min of 10 min"
std::string UseText(const BudgetOptions& budget, const BudgetUse& use, double elapsed);

}  // namespace talus::campaign
