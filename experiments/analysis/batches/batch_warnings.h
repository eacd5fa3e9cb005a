// What speaks against a comparison of batches: conditions that differ, and what each campaign warns
// of itself. One sentence each, with the folder before it.
#pragma once

#include <string>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

// The alarms of a campaign's answer; none where it has no answer yet.
std::vector<std::string> AlarmsOf(const campaign::JointView& batch);

// What a batch's trials do otherwise than the first one's with the same parameters: their powder,
// device, models, rules, scale factor.
std::vector<std::string> OtherConditions(const campaign::JointView& first,
                                         const campaign::JointView& batch);

}  // namespace talus::analysis
