#include "optimizer/posterior/robust_misfit.h"

#include <cmath>

namespace talus::optimizer {
namespace {

constexpr double kFreedom = 8;  // ν

}  // namespace

Eigen::ArrayXd RobustMisfit(const Eigen::ArrayXd& squared, Eigen::Index num_outputs) {
  const auto k = static_cast<double>(num_outputs);
  const Eigen::ArrayXd beyond =
      k + (kFreedom + k) * ((kFreedom + squared) / (kFreedom + k)).max(1e-300).log();
  return (squared <= k).select(squared, beyond);
}

// M has the density M^(K/2 - 1) exp(-ρ(M)/2): by the trapezoidal rule over ln M.
double RobustQuantile(Eigen::Index num_outputs, double probability) {
  constexpr int kSteps = 4000;
  constexpr double kRange = 12;  // ln M from ln K - 12 to ln K + 12: beyond lies nothing
  const auto k = static_cast<double>(num_outputs);
  const Eigen::ArrayXd log_m = std::log(k) + Eigen::ArrayXd::LinSpaced(kSteps, -kRange, kRange);
  const Eigen::ArrayXd m = log_m.exp();
  const Eigen::ArrayXd log_density = 0.5 * k * log_m - 0.5 * RobustMisfit(m, num_outputs);
  const Eigen::ArrayXd density = (log_density - log_density.maxCoeff()).exp();
  const double aim = probability * density.sum();
  double sum = 0;
  for (Eigen::Index i = 0; i < kSteps; ++i) {
    sum += density[i];
    if (sum >= aim) return m[i];
  }
  return m[kSteps - 1];
}

}  // namespace talus::optimizer
