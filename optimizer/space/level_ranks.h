// The coordinates of a table by rank: its values of each parameter, however far apart, at equal
// steps from 0 to 1, and linear between them.
//
// Who makes a table spaces its values so that each step matters about as much (0, 0.01, 0.05, 0.2,
// 0.7), and a process with one correlation length a parameter expects just that.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace talus::optimizer {

class LevelRanks {
 public:
  // One candidate a row, at least one.
  explicit LevelRanks(const Eigen::MatrixXd& candidates);

  Eigen::VectorXd ToRanks(const Eigen::VectorXd& point) const;
  // The other way round; both leave what is beyond the table's values at the nearest of them.
  Eigen::VectorXd FromRanks(const Eigen::VectorXd& ranks) const;

 private:
  std::vector<std::vector<double>> values_;  // of each coordinate, ascending
};

}  // namespace talus::optimizer
