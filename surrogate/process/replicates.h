// Evaluations pooled by point and scale factor: replicates become one point with mean and count.
//
// Exact, not an approximation: for m values y_j = f + noise, the likelihood of all of them is that
// of their mean, with noise variance n²/m, times a factor of n alone (PooledData::sum_of_squares).
#pragma once

#include <Eigen/Core>

#include "surrogate/process/covariance.h"

namespace talus::surrogate {

// Evaluations of one output, one a row. `growth` (covariance.h) and `level`, the index of the scale
// factor, stay empty where all are at the target.
struct Evaluations {
  Eigen::MatrixXd points;  // n × d, unit cube
  Eigen::VectorXd values;
  Eigen::VectorXd growth = {};
  Eigen::VectorXi level = {};
};

// Where one evaluation is made.
struct Site {
  Eigen::VectorXd x;  // unit cube
  double growth = 0;
  int level = 0;
};

struct PooledData {
  Sites sites;                     // distinct, in order of first appearance
  Eigen::VectorXi level;           // of each
  Eigen::VectorXd values;          // means over the replicates
  Eigen::VectorXd counts;          // number of replicates, >= 1
  Eigen::VectorXi first;           // the evaluation that appeared first, from 0
  Eigen::VectorXd sum_of_squares;  // Σ (y_j - mean)², one a scale factor
  Eigen::VectorXd num_extra;       // evaluations beyond one a site, one a scale factor

  Eigen::Index size() const { return values.size(); }
  double num_values() const { return counts.sum(); }
};

// `num_levels`: the number of scale factors.
PooledData Pool(const Evaluations& evaluations, int num_levels = 1);

// Adds one evaluation; returns the column it went to.
Eigen::Index AddTo(PooledData& data, const Site& site, double value);

}  // namespace talus::surrogate
