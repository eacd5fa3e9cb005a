#include "optimizer/fidelity/output_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::optimizer {
namespace {

const Levels kLevels({2, 1}, 0);

TEST(OutputNoise, FallsAlongTheModesAndWithTheGrainsSize) {
  const auto first = NoiseOfMode(kLevels, 0, 0.05, 1).noise_median;
  const auto fourth = NoiseOfMode(kLevels, 3, 0.05, 1).noise_median;
  EXPECT_NEAR(first[0], 2.2 * 0.05, 1e-12);
  EXPECT_NEAR(fourth[0], first[0] / 2, 1e-12);                 // 1/√4
  EXPECT_NEAR(first[1], first[0] * std::pow(2, -1.5), 1e-12);  // eight times as many grains
}

TEST(OutputNoise, IsAShareOfTheSpreadAndNeverAllOfIt) {
  EXPECT_NEAR(NoiseOfMode(kLevels, 0, 0.1, 2).noise_median[0], 0.11, 1e-12);
  EXPECT_NEAR(NoiseOfMode(kLevels, 0, 5, 1).noise_median[0], 0.8, 1e-12);
}

// Coarse heaps that tell nothing of true ones can only be taken for noise.
TEST(OutputNoise, IsKnownWellAtTheFinestScaleFactorOnly) {
  const auto log_sd = NoiseOfMode(kLevels, 0, 0.05, 1).noise_log_sd;
  EXPECT_GE(log_sd[0], 0.7);
  EXPECT_LE(log_sd[1], 0.2);
}

TEST(OutputNoise, IsVagueWhereNothingWasLeftOut) {
  for (const double spread : {0.0, 1.0}) {
    const auto options = NoiseOfMode(kLevels, 0, 0, spread);
    EXPECT_GE(options.noise_log_sd.minCoeff(), 0.7);
    EXPECT_GT(options.noise_median.minCoeff(), 0);
  }
}

}  // namespace
}  // namespace talus::optimizer
