#include "optimizer/outputs/output_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::optimizer {
namespace output_noise_test {

const Levels kLevels({2, 1}, 0);

TEST(OutputNoise, FallsAlongTheModesAndWithTheGrainsSize) {
  const auto first = NoiseOfMode(kLevels, 0, 0.05, 1);
  const auto fourth = NoiseOfMode(kLevels, 3, 0.05, 1);
  EXPECT_NEAR(first[0].median, 2.2 * 0.05, 1e-12);
  EXPECT_NEAR(fourth[0].median, first[0].median / 2, 1e-12);  // 1/√4
  // Eight times as many grains.
  EXPECT_NEAR(first[1].median, first[0].median * std::pow(2, -1.5), 1e-12);
}

TEST(OutputNoise, IsAShareOfTheSpreadAndNeverAllOfIt) {
  EXPECT_NEAR(NoiseOfMode(kLevels, 0, 0.1, 2).front().median, 0.11, 1e-12);
  EXPECT_NEAR(NoiseOfMode(kLevels, 0, 5, 1).front().median, 0.8, 1e-12);
}

// Coarse heaps that tell nothing of true ones can only be taken for noise.
TEST(OutputNoise, IsKnownWellAtTheFinestScaleFactorOnly) {
  const auto noise = NoiseOfMode(kLevels, 0, 0.05, 1);
  EXPECT_GE(noise[0].log_sd, 0.7);
  EXPECT_LE(noise[1].log_sd, 0.2);
}

TEST(OutputNoise, IsVagueWhereNothingWasLeftOut) {
  for (const double spread : {0.0, 1.0}) {
    for (const surrogate::LogNormal& noise : NoiseOfMode(kLevels, 0, 0, spread)) {
      EXPECT_GE(noise.log_sd, 0.7);
      EXPECT_GT(noise.median, 0);
    }
  }
}

}  // namespace output_noise_test
}  // namespace talus::optimizer
