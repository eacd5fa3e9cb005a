// What a campaign knows by what was reused, before it has simulated anything itself.
#pragma once

#include <string>
#include <vector>

#include "experiments/journal/records.h"
#include "optimizer/answer.h"
#include "optimizer/space/parameter_space.h"

namespace talus::campaign {

// "first answer, by what was reused: sliding_friction 0.45 (90 % in 0.4 … 0.5), …". Wants a
// posterior.
std::string FirstAnswerText(const optimizer::Answer& answer, const optimizer::ParameterSpace& space,
                            const std::vector<journal::ParameterRecord>& parameters);

}  // namespace talus::campaign
