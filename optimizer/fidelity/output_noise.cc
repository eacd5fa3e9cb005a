#include "optimizer/fidelity/output_noise.h"

#include <algorithm>
#include <cmath>

namespace talus::optimizer {
namespace {

constexpr double kVague = 0.7;  // log sd where nothing is known of this output

// `share` of the output's spread at the coarsest scale factor, less at finer ones; `log_sd` holds
// at the finest. Coarse heaps that tell nothing of true ones have to pass for noise.
surrogate::FidelityFitOptions Noise(const Levels& levels, double share, double log_sd) {
  surrogate::FidelityFitOptions options{
      .noise_median = Eigen::VectorXd(levels.size()),
      .noise_log_sd = Eigen::VectorXd::Constant(levels.size(), kVague)};
  for (int l = 0; l < levels.size(); ++l) {
    options.noise_median[l] = share * levels.NoiseAtTarget(0) / levels.NoiseAtTarget(l);
  }
  options.noise_log_sd[levels.finest()] = log_sd;
  return options;
}

}  // namespace

surrogate::FidelityFitOptions NoiseOfMode(const Levels& levels, int mode, double next_sd,
                                          double spread) {
  constexpr double kFactor = 2.2;
  constexpr double kLogSd = 0.2;
  constexpr double kLeast = 0.01;  // below, nothing was left out that tells of noise
  constexpr double kMost = 0.8;    // a mode is kept for some signal
  constexpr double kUnknown = 0.1;
  const double share = kFactor * next_sd / std::sqrt(mode + 1.0) / spread;
  if (!(share > kLeast)) return Noise(levels, kUnknown, kVague);
  return Noise(levels, std::min(share, kMost), kLogSd);
}

surrogate::FidelityFitOptions NoiseOfScalar(const Levels& levels) {
  constexpr double kUsual = 0.2;
  return Noise(levels, kUsual, kVague);
}

}  // namespace talus::optimizer
