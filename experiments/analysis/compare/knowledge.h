// What each objective knows of the parameters: the posterior that it gives by itself, from the same
// trials, with the same statistics. So an angle and a whole heap are compared like with like: by
// the share of the searched ranges that each leaves, and whether it still holds the recommended
// set.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

// The whole heap (which SAD and RMSE measure), each angle of repose and each measured number of one
// experiment; where `absent` is said, why it cannot be told.
std::vector<ObjectiveKnowledge> KnowledgeOf(const campaign::JointView& view, int experiment,
                                            const Eigen::VectorXd& recommended);

// For people: "2.6 % (1.9 to 3.5 %)".
std::string RegionText(const ObjectiveKnowledge& knowledge);

// What the comparison comes to, in a sentence; empty with less than two to compare.
std::string KnowledgeSentence(const std::vector<ObjectiveKnowledge>& all);

}  // namespace talus::analysis
