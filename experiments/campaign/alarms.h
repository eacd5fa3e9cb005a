// What of a result must be said aloud: every alarm in one list, the gravest first, the same on the
// terminal, in result.json and in the report.
#pragma once

#include <vector>

#include "experiments/campaign/answer/campaign_result.h"
#include "experiments/campaign/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"
#include "optimizer/space/parameter_space.h"
#include "optimizer/strategies/strategy.h"

namespace talus::campaign {

struct AlarmBasis {
  const optimizer::Answer& answer;
  const optimizer::ParameterSpace& space;
  const CampaignSpec& spec;
  const journal::CampaignRecord& campaign;
  const Reference& reference;  // of the first experiment
  const std::vector<journal::TrialRecord>& trials;
};

// Adds them to result.warnings; the result is complete but for these.
void AddAlarms(const AlarmBasis& basis, CampaignResult& result);

// The recommended set held against its prediction and against the best trial of the search.
std::vector<ResultWarning> DisappointmentAlarms(const CampaignResult& result,
                                                const std::vector<journal::TrialRecord>& trials,
                                                const Reference& reference);

// Two parameters that are known together only; none where each is known well, or the pair is not
// what leaves the answer open.
std::vector<ResultWarning> CorrelationAlarms(const CampaignResult& result);

// Parameters of the recommended set that lie on an end of their range.
std::vector<ResultWarning> BoundAlarms(const CampaignResult& result,
                                       const optimizer::ParameterSpace& space);

// Whether the budget ended the search before its stopping rule did.
std::vector<ResultWarning> BudgetAlarms(const CampaignResult& result);

// Whether the model predicts what it was not told.
std::vector<ResultWarning> ModelAlarms(const optimizer::Answer& answer);

}  // namespace talus::campaign
