// How many sets there are among evaluations, of which some repeat others.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "surrogate/same_point.h"

namespace talus::optimizer {

class DistinctPoints {
 public:
  // Counts a point, which must outlive this, unless it is one of those before but for rounding.
  void Add(const Eigen::VectorXd& point) {
    const auto is_it = [&](const Eigen::VectorXd* other) {
      return surrogate::SamePoint(*other, point);
    };
    if (std::ranges::none_of(points_, is_it)) points_.push_back(&point);
  }
  int size() const { return static_cast<int>(points_.size()); }

 private:
  std::vector<const Eigen::VectorXd*> points_;
};

}  // namespace talus::optimizer
