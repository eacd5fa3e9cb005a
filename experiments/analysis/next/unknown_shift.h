// A test that hangs on something unknown teaches less:
//
//   C' = C + Σ_m δ_m δ_mᵀ
//
// C are the errors of a test's outputs, δ_m is what the m-th unknown thing shifts them by where it
// is moved to another value that it may well have: one standard deviation of what is not known.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/posterior/expected_learning.h"

namespace talus::analysis {

// Outputs of a test's simulations, one a row; NaN where one is undefined. The first `num_modes` are
// those of an image.
struct MovedRows {
  const Eigen::MatrixXd& moved;
  const Eigen::MatrixXd& base;
  const Eigen::VectorXd& noise;  // variance of one simulation, of each output, > 0
  Eigen::Index num_modes = 0;
};

// Variance of one row about the mean of its set, pooled over the sets; 0 where an output never
// occurs twice in a set.
Eigen::VectorXd PooledVariance(const std::vector<Eigen::MatrixXd>& sets);

// δ: the mean of the moved rows less that of the others. The image's modes together, and each
// number by itself, are zero where chance makes as much once in a thousand times (χ²), and else
// drawn in by chance's part. An output that is undefined either way says nothing.
Eigen::VectorXd ShiftBeyondChance(const MovedRows& rows);

// The measurement with errors C' in place of C, in outputs turned so that their errors are
// independent and 1.
optimizer::PredictedMeasurement WithShifts(const optimizer::PredictedMeasurement& predicted,
                                           const std::vector<Eigen::VectorXd>& shifts);

}  // namespace talus::analysis
