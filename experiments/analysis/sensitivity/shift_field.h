// How far a move shifts the outputs of an experiment at any set, from the sets at which both were
// simulated.
//
// Their mean, weighted by the inverse square of the distance (D. Shepard, Proc. 23rd ACM National
// Conference, 517, 1968): of one set the same everywhere.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/analysis/sensitivity/shift.h"

namespace talus::analysis {

class ShiftField {
 public:
  // `point`: unit cube. All shifts have the same outputs.
  void Add(const Eigen::VectorXd& point, Shift shift);

  // One point a row, an output a column; wants one set at least.
  Eigen::MatrixXd At(const Eigen::MatrixXd& points) const;
  // That chance gives the shift at the last set.
  const Eigen::VectorXd& variance() const { return shifts_.back().variance; }

 private:
  std::vector<Eigen::VectorXd> points_{};
  std::vector<Shift> shifts_{};
};

}  // namespace talus::analysis
