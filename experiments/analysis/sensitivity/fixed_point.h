// A point that a costly function maps to itself, from a few of its values.
//
// Anderson's mixing of the last two values (D. G. Anderson, J. ACM 12, 547, 1965): exact after two
// values of a linear function along one direction, where plain iteration may swing about.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace talus::analysis {

class FixedPoint {
 public:
  // `scale`: what counts as one in each coordinate, > 0.
  explicit FixedPoint(Eigen::VectorXd scale) : scale_(std::move(scale)) {}

  // Takes the value of the function at a point. Returns the estimate of the fixed point, where to
  // ask next.
  Eigen::VectorXd Next(const Eigen::VectorXd& at, const Eigen::VectorXd& value);

 private:
  struct Step {
    Eigen::VectorXd value;
    Eigen::VectorXd residual;  // value - point, in scales
  };

  Eigen::VectorXd scale_;
  std::optional<Step> last_{};
};

}  // namespace talus::analysis
