// DIR/goal: what a campaign with a goal has found of it so far. Each look at it has a folder named
// after the number of trials that had ended, with the runs that were made for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"
#include "optimizer/stop_reason.h"

namespace talus::campaign {

// goal.json of one look; widths in the observable's unit as results have it.
struct GoalState {
  std::string goal{};       // what was asked for, as GoalText writes it
  std::int64_t after = 0;   // trials of noise and search that had ended
  int num_experiments = 0;  // that it was judged with, and parameters
  int num_parameters = 0;
  double half_width = base::kNotKnown;             // of the 90 %: the next two in squares
  double parameters_half_width = base::kNotKnown;  // what the sets leave open
  double surrogate_half_width = base::kNotKnown;   // of the number as a function of the sets
  double least_half_width = base::kNotKnown;       // expected once every set had been simulated
  int num_runs = 0;                                // of all looks so far, at this goal
  double core_time = 0;                            // of every run in DIR/goal so far [s]
  std::optional<optimizer::StopReason> reason{};   // why the search may end; none: it goes on
  std::string failure{};  // why no run of it has ended well; nothing more is then run for it

  static constexpr base::FieldKey kKeys[] = {{"after", "after_trials"},
                                             {"half_width", "half_width_90"},
                                             {"parameters_half_width", "parameters_half_width_90"},
                                             {"surrogate_half_width", "surrogate_half_width_90"},
                                             {"least_half_width", "least_half_width_90"},
                                             {"core_time", "core_time_s"}};
  TALUS_FIELDS(goal, after, num_experiments, num_parameters, half_width, parameters_half_width,
               surrogate_half_width, least_half_width, num_runs, core_time, reason, failure);
};

struct CampaignSpec;

struct GoalSpec;

std::filesystem::path GoalFolder(const std::filesystem::path& campaign);  // absolute
// Folders of the looks, by number of trials.
std::vector<std::filesystem::path> GoalLooks(const std::filesystem::path& campaign);

// Core time of every run in DIR/goal [s], whatever goal and parameters it was made for.
double GoalCoreTime(const std::filesystem::path& campaign);
// The same as the last look at this spec's goal knows it, where that is more: an engine that went
// on from a checkpoint took longer than its last process.
double GoalCoreTime(const std::filesystem::path& campaign, const CampaignSpec& spec);
// The same of one look.
double LookCoreTime(const std::filesystem::path& look);

// What a look begins with.
GoalState NewGoalState(const CampaignSpec& spec, std::int64_t after);

// The last look that was finished, at what this spec asks for; none where it asks for nothing. One
// that was judged with other experiments or parameters is no reason to end the search.
std::optional<GoalState> LastGoal(const std::filesystem::path& campaign, const CampaignSpec& spec);
void KeepGoal(const std::filesystem::path& look, const GoalState& state);

// The spec's goal as a line; states of another one do not count.
std::string GoalText(const CampaignSpec& spec);

// "angle_deg of drum known to ± 1.2 (90 %) after 24 trials, asked for ± 1; 12 runs of it".
std::string TextOf(const GoalState& state, const GoalSpec& asked);

// The number of ended trials at which the goal is looked at after the look at `last`; 0: the first.
std::int64_t NextLook(std::int64_t last);
// The same after this look, sooner where experiments or parameters have come since; none: the
// first.
std::int64_t NextLook(const std::optional<GoalState>& last, const CampaignSpec& spec);

}  // namespace talus::campaign
