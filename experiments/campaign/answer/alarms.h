// What must be said aloud of an answer: every alarm in one list, the gravest first, the same on the
// terminal, in result.json, on the card and in the report.
#pragma once

#include <optional>
#include <vector>

#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/folder/goal_folder.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

struct AlarmBasis {
  const CampaignSpec& spec;
  const journal::CampaignRecord& campaign;
  const std::vector<Reference>& references;  // one an experiment
  const std::vector<journal::TrialRecord>& trials;
  const std::optional<GoalState>& goal;  // the last look at the spec's goal
};

// The answer is complete but for these, which it gains.
void AddAlarms(const AlarmBasis& basis, Answer& answer);

// Measurements that the recommended set does not give; of an experiment that no set fits, the
// posterior's alarm says so.
std::vector<Alarm> MissAlarms(const Answer& answer);

// Experiments whose simulations are not told apart by any number.
std::vector<Alarm> AlikeAlarms(const std::vector<journal::TrialRecord>& trials,
                               const std::vector<ResultExperiment>& experiments);

// Whether the posterior fits at all, and what it stands on.
std::vector<Alarm> PosteriorAlarms(const Answer& answer);

// The recommended set held against its prediction.
std::vector<Alarm> PredictionAlarms(const Answer& answer);

// … and against the best trial of the search. Where several experiments are to be met, a trial of
// one may well meet that one better.
std::vector<Alarm> SearchAlarms(const Answer& answer,
                                const std::vector<journal::TrialRecord>& trials,
                                const std::vector<Reference>& references);

// Two parameters that are known together only; none where each is known well, or the pair is not
// what leaves the answer open.
std::vector<Alarm> CorrelationAlarms(const Answer& answer);

// Parameters of the recommended set that lie on an end of their range.
std::vector<Alarm> BoundAlarms(const Answer& answer);

// Parameters whose posterior lies far from their prior.
std::vector<Alarm> PriorAlarms(const Answer& answer);

// Whether the budget ended the search before its stopping rule did.
std::vector<Alarm> BudgetAlarms(const Answer& answer);

// Whether it ended without what its goal asks for; not where the goal itself ended it.
std::vector<Alarm> GoalAlarms(const CampaignSpec& spec, const std::optional<GoalState>& goal);

}  // namespace talus::campaign
