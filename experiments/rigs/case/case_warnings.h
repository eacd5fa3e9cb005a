// What a user should know of a case before trusting its result.
#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// Fewer grains across the plate of a heap that decides are worth a warning: in `validate`, a
// trial's result and a campaign's alarms. Coarser ones that only guide a search are not.
inline constexpr double kAdvisedAcross = 30;
double GrainsAcrossPlate(const Case& rig_case);
// "only 25 grains across the plate PLATE at their true size: …", and what would help.
std::string FewGrainsText(double across, double scale_factor, const std::string& plate);

// What a user should know before trusting the result of any rig, a sentence each; none when all is
// well.
std::vector<std::string> CaseWarnings(const Case& rig_case);
// The same but for the number of grains.
std::vector<std::string> SetUpWarnings(const Case& rig_case);

}  // namespace talus::rigs
