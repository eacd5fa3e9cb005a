#include "experiments/analysis/sensitivity/fixed_point.h"

#include <algorithm>

namespace talus::analysis {
namespace {

// Of the value before the last. Beyond these bounds the two residuals are nearly the same, and
// their difference is mostly noise.
constexpr double kLeastShare = -1;
constexpr double kMostShare = 0.75;

}  // namespace

Eigen::VectorXd FixedPoint::Next(const Eigen::VectorXd& at, const Eigen::VectorXd& value) {
  const Step step{.value = value, .residual = (value - at).cwiseQuotient(scale_)};
  Eigen::VectorXd next = value;
  if (last_) {
    const Eigen::VectorXd change = step.residual - last_->residual;
    const double square = change.squaredNorm();
    const double share =
        square > 0 ? std::clamp(step.residual.dot(change) / square, kLeastShare, kMostShare) : 0;
    next += share * (last_->value - value);
  }
  last_ = step;
  return next;
}

}  // namespace talus::analysis
