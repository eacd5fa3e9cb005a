#include "optimizer/outputs/output_noise.h"

#include <algorithm>
#include <cmath>

namespace talus::optimizer {
namespace {

constexpr double kVague = 0.7;  // log sd where nothing is known of this output

// `share` of the output's spread at the coarsest scale factor, less at finer ones; `log_sd` holds
// at the finest. Coarse heaps that tell nothing of true ones have to pass for noise.
std::vector<surrogate::LogNormal> Noise(const Levels& levels, double share, double log_sd) {
  std::vector<surrogate::LogNormal> priors;
  for (int l = 0; l < levels.size(); ++l) {
    priors.push_back({.median = share * levels.NoiseAtTarget(0) / levels.NoiseAtTarget(l),
                      .log_sd = l == levels.finest() ? log_sd : kVague});
  }
  return priors;
}

}  // namespace

std::vector<surrogate::LogNormal> NoiseOfMode(const Levels& levels, int mode, double next_sd,
                                              double spread) {
  constexpr double kFactor = 2.2;
  constexpr double kLogSd = 0.2;
  constexpr double kLeast = 0.001;  // below, nothing was left out that tells of noise
  constexpr double kMost = 0.8;     // a mode is kept for some signal
  constexpr double kUnknown = 0.1;
  const double share = kFactor * next_sd / std::sqrt(mode + 1.0) / spread;
  if (!(share > kLeast)) return Noise(levels, kUnknown, kVague);
  return Noise(levels, std::min(share, kMost), kLogSd);
}

std::vector<surrogate::LogNormal> NoiseOfScalar(const Levels& levels) {
  constexpr double kUsual = 0.2;
  return Noise(levels, kUsual, kVague);
}

}  // namespace talus::optimizer
