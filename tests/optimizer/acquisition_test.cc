#include "optimizer/search/acquisition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace talus::optimizer {
namespace acquisition_test {

using Score = std::function<Acquisition(double mean, double sd)>;

// Central differences with a relative step of 1e-6 err by 1e-9 or so of the slope.
void ExpectSlopes(const Score& score, double mean, double sd) {
  const Acquisition at = score(mean, sd);
  const double h = 1e-6 * sd;
  const double by_mean = (score(mean + h, sd).value - score(mean - h, sd).value) / (2 * h);
  const double by_sd = (score(mean, sd + h).value - score(mean, sd - h).value) / (2 * h);
  EXPECT_NEAR(at.mean_slope, by_mean, 1e-6 * (1 + std::abs(by_mean))) << mean << ' ' << sd;
  EXPECT_NEAR(at.sd_slope, by_sd, 1e-6 * (1 + std::abs(by_sd))) << mean << ' ' << sd;
}

TEST(Acquisition, SlopesEqualDifferencesFromCertainGainToHopelessness) {
  for (const double mean : {-3.0, 0.2, 1.0, 3.9, 4.1, 8.0, 30.0}) {
    for (const double sd : {0.3, 1.0, 2.5}) {
      ExpectSlopes([](double m, double s) { return LogExpectedImprovement(m, s, 0.5); }, mean, sd);
      ExpectSlopes(
          [](double m, double s) { return AugmentedLogExpectedImprovement(m, s, 0.5, 0.4); }, mean,
          sd);
      ExpectSlopes([](double m, double s) { return NegativeLowerBound(m, s, 2); }, mean, sd);
    }
  }
}

// E[max(m - f, 0)] by the trapezoidal rule in 2e5 steps over ± 12 sd: good to 1e-9.
TEST(Acquisition, LogExpectedImprovementIsTheLogOfTheIntegral) {
  for (const double mean : {-1.0, 0.5, 2.0, 4.4, 4.6, 6.0}) {
    const double incumbent = 0.5;
    double sum = 0;
    const int kSteps = 200000;
    for (int i = 0; i <= kSteps; ++i) {
      const double z = -12 + 24.0 * i / kSteps;
      sum += std::max(0.0, incumbent - (mean + z)) * std::exp(-z * z / 2);
    }
    const double expected = sum * 24.0 / kSteps / std::sqrt(2 * M_PI);
    EXPECT_NEAR(LogExpectedImprovement(mean, 1, incumbent).value, std::log(expected), 1e-6) << mean;
  }
}

TEST(Acquisition, StaysFiniteAndOrderedWhereImprovementUnderflows) {
  const Acquisition near = LogExpectedImprovement(100, 0.1, 0);
  const Acquisition far = LogExpectedImprovement(101, 0.1, 0);
  EXPECT_TRUE(std::isfinite(far.value));
  EXPECT_GT(near.value, far.value);
  EXPECT_TRUE(std::isfinite(LogExpectedImprovement(1, 0, 0).value));
}

// Nothing is learnt where the posterior is much sharper than the noise of an evaluation.
TEST(Acquisition, NoiseTakesTheWorthOutOfWellKnownPlaces) {
  const double known = AugmentedLogExpectedImprovement(0, 0.01, 0, 1).value;
  const double vague = AugmentedLogExpectedImprovement(0, 1, 0, 1).value;
  const double ratio =
      LogExpectedImprovement(0, 1, 0).value - LogExpectedImprovement(0, 0.01, 0).value;
  EXPECT_GT(vague - known, ratio + 5);  // ln(0.29 / 5e-5) = 8.7
  EXPECT_EQ(AugmentedLogExpectedImprovement(0, 1, 0, 0).value,
            LogExpectedImprovement(0, 1, 0).value);
}

}  // namespace acquisition_test
}  // namespace talus::optimizer
