// Ranges that hold the truth all together, from a sample of what it may be.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/answer.h"

namespace talus::optimizer {

// One range a column of `sample` (one draw a row, at least one), such that a share `confidence` in
// (0, 1) of the draws lies inside all of them at once. Each range leaves out as many draws below as
// above [besag1995]. With one column these are the usual quantiles.
std::vector<Range> CredibleRanges(const Eigen::MatrixXd& sample, double confidence = kRegionLevel);

// As an answer states them: the ranges of what is asked for hold all together, and that of each
// nuisance, a column of these, by itself.
std::vector<Range> AskedRanges(const Eigen::MatrixXd& sample,
                               const std::vector<Eigen::Index>& nuisances);

// high - low of each 90 % range.
Eigen::VectorXd CredibleWidths90(const Eigen::MatrixXd& sample,
                                 const std::vector<Eigen::Index>& nuisances = {});

}  // namespace talus::optimizer
