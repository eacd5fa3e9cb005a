#include "base/student_factor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::base {
namespace {

constexpr double kLikeNormal = 1e4;  // degrees of freedom: more change t by less than 2e-4

// ∫₀^θ cos^(ν-1) u du, by Simpson's rule.
double Integral(double degrees, double theta) {
  constexpr int kIntervals = 400;
  const double step = theta / kIntervals;
  double sum = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double weight = i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * std::pow(std::cos(i * step), degrees - 1);
  }
  return sum * step / 3;
}

double Known(double degrees) { return std::clamp(degrees, 1.0, kLikeNormal); }

// P(|T| ≤ √ν tan θ).
double ShareAt(double nu, double theta) {
  const double scale =
      2 * std::exp(std::lgamma((nu + 1) / 2) - std::lgamma(nu / 2)) / std::sqrt(std::numbers::pi);
  return scale * Integral(nu, theta);
}

}  // namespace

double StudentFactor(double degrees, double share) {
  constexpr int kHalvings = 50;
  const double nu = Known(degrees);
  double low = 0;
  double high = std::numbers::pi / 2;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (ShareAt(nu, middle) < share ? low : high) = middle;
  }
  return std::sqrt(nu) * std::tan((low + high) / 2);
}

double StudentShare(double degrees, double t) {
  const double nu = Known(degrees);
  return std::min(ShareAt(nu, std::atan(t / std::sqrt(nu))), 1.0);
}

double NormalError(double standard_error, int degrees) {
  constexpr double kRange = 0.9;
  if (degrees == 0) return standard_error;
  return standard_error * StudentFactor(degrees, kRange) / StudentFactor(kLikeNormal, kRange);
}

}  // namespace talus::base
