// Points, and sets of them: as models take them, one a row, and as lists.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "optimizer/space/domain.h"

namespace talus::optimizer {

inline Eigen::VectorXd VectorOf(const std::vector<double>& point) {
  return Eigen::Map<const Eigen::VectorXd>(point.data(), static_cast<Eigen::Index>(point.size()));
}

// Those of the rows that the domain contains, at its levels; of a domain that is a list, the
// candidates nearest to them.
Eigen::MatrixXd Inside(const Domain& domain, const Eigen::MatrixXd& points);

// One matrix above the other.
Eigen::MatrixXd Stack(const Eigen::MatrixXd& top, const Eigen::MatrixXd& bottom);

// Whether one of `points` is the same point (surrogate::SamePoint).
bool IsAmong(const Eigen::VectorXd& point, std::span<const Eigen::VectorXd> points);

}  // namespace talus::optimizer
