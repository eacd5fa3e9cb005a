#include "optimizer/outputs/levels.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace talus::optimizer {

Levels::Levels(std::vector<double> scale_factors, double target)
    : factors_(std::move(scale_factors)) {
  std::sort(factors_.begin(), factors_.end(), std::greater<>());
  target_ = target > 0 ? target : factors_.back();
}

double Levels::growth(int level) const {
  const double whole = factors_.front() - target_;
  return whole > 0 ? (factor(level) - target_) / whole : 0;
}

int Levels::LevelOf(double factor) const {
  const auto distance = [&](double f) { return std::abs(f - factor); };
  const auto nearest = std::min_element(factors_.begin(), factors_.end(), [&](double a, double b) {
    return distance(a) < distance(b);
  });
  return static_cast<int>(nearest - factors_.begin());
}

}  // namespace talus::optimizer
