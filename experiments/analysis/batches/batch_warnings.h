// What speaks against a comparison of batches: conditions that differ, and what each campaign warns
// of itself. One sentence each, with the folder before it.
#pragma once

#include <string>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

// The alarms of a campaign's answer; where it has no answer yet, that it has none.
std::vector<std::string> AlarmsOf(const campaign::JointView& batch);

// That the batch's trials were simulated by another engine, or by another deck of it; empty if not.
std::string OtherEngine(const campaign::JointView& first, const campaign::JointView& batch);

// That the posterior of one of the two is the other's prior, or that of a third campaign both's: a
// difference is then shown smaller than it is. A prior's own prior is not looked at. Empty if not.
std::string CommonPrior(const campaign::JointView& first, const campaign::JointView& batch);

// What a batch's trials do otherwise than the first one's with the same parameters, in experiments
// of the same name: their powder, device, models, rules, scale factor.
std::vector<std::string> OtherConditions(const campaign::JointView& first,
                                         const campaign::JointView& batch);

}  // namespace talus::analysis
