// Evaluations pooled by point: replicates become one point with their mean and count.
//
// Exact, not an approximation: for m values y_j = f + noise, the likelihood of all of them is that
// of their mean, with noise variance n²/m, times a factor of n alone (PooledData::sum_of_squares).
#pragma once

#include <Eigen/Core>

namespace talus::surrogate {

struct PooledData {
  Eigen::MatrixXd points;  // d × u, the distinct points as columns, in order of first appearance
  Eigen::VectorXd values;  // u, means over the replicates
  Eigen::VectorXd counts;  // u, number of replicates, >= 1
  double sum_of_squares = 0;  // Σ (y_j - mean)² over all points, in squared units of the values
  int num_values = 0;         // evaluations before pooling
};

// Points nearer than this in every coordinate are the same: rounding on the way through native
// values and back must not hide a replicate.
inline constexpr double kSamePoint = 1e-9;

// `points` has one evaluation a row.
PooledData Pool(const Eigen::MatrixXd& points, const Eigen::VectorXd& values);

// Adds one evaluation; returns the column it went to.
Eigen::Index AddTo(PooledData& data, const Eigen::VectorXd& point, double value);

}  // namespace talus::surrogate
