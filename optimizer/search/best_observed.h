// The answer of a strategy that has no model: the best evaluation, taken at its word.
#pragma once

#include <span>

#include "optimizer/answer.h"
#include "optimizer/observation.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

// `how` names the strategy in Answer::model.
Answer BestObserved(std::span<const Observation> told, const Domain& domain,
                    const std::string& how);

}  // namespace talus::optimizer
