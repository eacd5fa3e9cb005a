// No seed fails outright: on a curved valley with noise, the worst of 20 seeds recommends a
// better point than the median of as many random searches, which take their best evaluation at its
// word.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "optimizer/strategy/scalar_strategy.h"

namespace talus::optimizer {
namespace scalar_strategy_seeds_test {

constexpr int kSeeds = 20;
constexpr int kBudget = 40;

double Valley(const Eigen::VectorXd& x) {
  const double bend = x[1] - 0.8 * x[0] * x[0] - 0.1;
  return 10 * bend * bend + std::pow(x[0] - 0.6, 2) + std::pow(x[2] - 0.3, 2);
}

// Scatter of 5 % of the valley's spread over the cube.
double Noisy(const Eigen::VectorXd& x, std::uint64_t seed, int evaluation) {
  base::Random random(seed, base::Stream("valley"), static_cast<std::uint64_t>(evaluation));
  return Valley(x) + 0.05 * random.Normal();
}

double ByRandomSearch(std::uint64_t seed) {
  base::Random random(seed, base::Stream("random search"));
  double lowest = INFINITY;
  double truth = 0;
  for (int i = 0; i < kBudget; ++i) {
    const Eigen::Vector3d x(random.Uniform(), random.Uniform(), random.Uniform());
    const double value = Noisy(x, seed, i);
    if (value < lowest) {
      lowest = value;
      truth = Valley(x);
    }
  }
  return truth;
}

double ByStrategy(std::uint64_t seed) {
  ScalarStrategy strategy({.num_parameters = 3}, {.seed = seed});
  for (int i = 0; i < kBudget; ++i) {
    const Eigen::VectorXd point = strategy.Ask(1, {}).at(0).point;
    strategy.Tell({.point = point, .value = Noisy(point, seed, i), .field = {}});
  }
  return Valley(strategy.Recommend().point);
}

TEST(ScalarStrategySeeds, WorstOfTwentyBeatsTheMedianOfRandomSearch) {
  std::vector<double> random;
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    random.push_back(ByRandomSearch(seed));
    worst = std::max(worst, ByStrategy(seed));
  }
  std::nth_element(random.begin(), random.begin() + kSeeds / 2, random.end());
  EXPECT_LT(worst, random[kSeeds / 2]);
}

}  // namespace scalar_strategy_seeds_test
}  // namespace talus::optimizer
