#include "optimizer/search/acquisition.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"

namespace talus::optimizer {
namespace {

constexpr double kLeastSd = 1e-150;

using base::NormalDensity;
using base::NormalProbability;

struct LogH {
  double value = 0;
  double slope = 0;  // d ln h / dz = Φ / h
};

LogH LogHAt(double z) {
  if (z > -4) {
    const double h = NormalDensity(z) + z * NormalProbability(z);
    return {.value = std::log(h), .slope = NormalProbability(z) / h};
  }
  // h = φ (1 + z M), z = -t, with Mills's ratio M = Φ(z) / φ(z) = 1/(t + 1/r) and the continued
  // fraction r = t + 2/(t + 3/(t + …)): 1 - t M = M / r without cancellation. 12 terms give 1e-12.
  const double t = -z;
  double tail = t;
  for (int k = 12; k >= 2; --k) tail = t + k / tail;
  const double mills = 1 / (t + 1 / tail);
  const double rest = mills / tail;  // 1 + z M
  return {.value = -z * z / 2 - base::kLogRootTwoPi + std::log(rest), .slope = mills / rest};
}

}  // namespace

Acquisition LogExpectedImprovement(double mean, double sd, double incumbent) {
  const double s = std::max(sd, kLeastSd);
  const double z = (incumbent - mean) / s;
  const LogH log_h = LogHAt(z);
  return {.value = std::log(s) + log_h.value,
          .mean_slope = -log_h.slope / s,
          .sd_slope = (1 - z * log_h.slope) / s};
}

Acquisition AugmentedLogExpectedImprovement(double mean, double sd, double incumbent,
                                            double noise) {
  Acquisition result = LogExpectedImprovement(mean, sd, incumbent);
  if (!(noise > 0)) return result;
  const double s = std::max(sd, kLeastSd);
  const double total = std::sqrt(s * s + noise * noise);
  // 1 - n/T = s² / (T (T + n)), without cancellation.
  result.value += 2 * std::log(s) - std::log(total) - std::log(total + noise);
  result.sd_slope += 2 / s - s / (total * total) - s / (total * (total + noise));
  return result;
}

Acquisition NegativeLowerBound(double mean, double sd, double num_sds) {
  return {.value = num_sds * sd - mean, .mean_slope = -1, .sd_slope = num_sds};
}

}  // namespace talus::optimizer
