// How parameters hang together in a sample.
#pragma once

#include <Eigen/Core>

namespace talus::optimizer {

// Spearman's rank correlation between the columns of `sample`, one draw a row and no column
// constant: a valley that is bent is as tight as a straight one.
Eigen::MatrixXd RankCorrelation(const Eigen::MatrixXd& sample);

}  // namespace talus::optimizer
