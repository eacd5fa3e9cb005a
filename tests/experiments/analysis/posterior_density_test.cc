#include "experiments/analysis/report/views/posterior_density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace talus::analysis {
namespace posterior_density_test {

TEST(PosteriorDensity, AnEvenSampleHasAnEvenDensity) {
  const Eigen::VectorXd even = Eigen::VectorXd::LinSpaced(2000, 0, 1);
  for (const double density : MarginalDensity(even, 40)) EXPECT_NEAR(density, 1, 0.1);
}

// A region that is drawn larger than it is contradicts the share that the verdict states.
TEST(PosteriorDensity, TheRegionOfABentBandIsAsLargeAsTheBand) {
  constexpr double kThick = 0.04;
  Eigen::MatrixXd draws(2000, 2);
  base::Random random(3, base::Stream("bent band"));
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const double x = 0.1 + 0.8 * random.Uniform();
    draws.row(i) << x, 0.8 - 1.2 * x * (1 - 0.4 * x) + kThick * (random.Uniform() - 0.5);
  }
  const Eigen::VectorXd level_of = Eigen::VectorXd::Constant(draws.rows(), 0.5);
  const std::vector<double> levels = ProjectedLevels(draws, level_of, 120);
  const auto inside = std::count_if(levels.begin(), levels.end(), [](double l) { return l < 0.9; });
  const double band = 0.8 * kThick;
  // 0.005 of 0.04 beyond each edge; kernels of a cell of 1/60 made it 1.9 bands.
  EXPECT_NEAR(static_cast<double>(inside) / (120 * 120), 1.2 * band, 0.2 * band);
}

// The shadow of a ball: a disc without holes, however few of its draws are near its rim.
TEST(PosteriorDensity, TheShadowOfABallHasNoHoles) {
  constexpr int kCells = 120;
  Eigen::MatrixXd draws(2000, 2);
  Eigen::VectorXd level_of(draws.rows());
  base::Random random(5, base::Stream("ball"));
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const Eigen::Vector3d z(random.Normal(), random.Normal(), random.Normal());
    draws.row(i) = 0.5 + 0.1 * z.head(2).transpose().array();
    level_of[i] = z.norm() < 1.538 ? 0.4 : 0.95;  // half of them: the median of chi with 3
  }
  const std::vector<double> levels = ProjectedLevels(draws, level_of, kCells);
  double inside = 0;
  double missing = 0;
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const double off = std::hypot(x + 0.5 - 60, y + 0.5 - 60) / (0.1 * kCells);
      const bool dark = levels[static_cast<std::size_t>(kCells * y + x)] < 0.5;
      inside += dark ? 1 : 0;
      missing += off < 1.2 && !dark ? 1 : 0;
    }
  }
  EXPECT_EQ(missing, 0);
  // The disc of draws that reach half as far as their neighbours are, and gaps at the rim.
  const double disc = std::numbers::pi * std::pow(1.538 * 0.1 * kCells, 2);
  EXPECT_NEAR(inside / disc, 1, 0.15);
}

// A set that is said to fit equally must not lie where the figure says "ruled out".
TEST(PosteriorDensity, ASetOfTheRegionLiesOnItsShadowHoweverThinThereTheDrawsAre) {
  Eigen::MatrixXd draws(1000, 2);
  Eigen::VectorXd level_of(draws.rows());
  base::Random random(4, base::Stream("thin tail"));
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const bool tail = i % 25 == 0;
    draws.row(i) << (tail ? random.Uniform() : 0.2 * random.Uniform()), random.Uniform();
    level_of[i] = tail ? 0.89 : 0.4;
  }
  const std::vector<double> levels = ProjectedLevels(draws, level_of, 50);
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const auto cell = static_cast<std::size_t>(50 * draws(i, 0)) +
                      50 * static_cast<std::size_t>(50 * draws(i, 1));
    EXPECT_LE(levels[cell], level_of[i]);
  }
}

}  // namespace posterior_density_test
}  // namespace talus::analysis
