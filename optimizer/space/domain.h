// Where a strategy may look: the unit cube, less what constraints forbid.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace talus::optimizer {

struct Domain {
  int num_parameters = 3;                     // 1 … 6
  std::vector<Eigen::VectorXd> guesses = {};  // points to be evaluated first, unit cube
  std::function<bool(const Eigen::VectorXd&)> feasible = {};  // empty: the whole cube

  bool Contains(const Eigen::VectorXd& point) const {
    return (point.array() >= 0).all() && (point.array() <= 1).all() &&
           (!feasible || feasible(point));
  }
};

// Two points nearer than this in every coordinate are the same one: a point that went through
// native values and back differs by rounding only.
inline constexpr double kSamePoint = 1e-9;

inline bool SamePoint(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() <= kSamePoint;
}

}  // namespace talus::optimizer
