// When two points of the unit cube count as one.
#pragma once

#include <Eigen/Core>

namespace talus::surrogate {

// Two points nearer than this in every coordinate are the same one: a point that went through
// native values and back differs by rounding only, and is a replicate.
inline constexpr double kSamePoint = 1e-9;

inline bool SamePoint(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() <= kSamePoint;
}

}  // namespace talus::surrogate
