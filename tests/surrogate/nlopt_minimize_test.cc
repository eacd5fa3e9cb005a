#include "surrogate/nlopt_minimize.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace talus::surrogate {
namespace nlopt_minimize_test {

double Bowl(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
  const Eigen::Vector2d away = x - Eigen::Vector2d(0.3, 0.6);
  if (gradient != nullptr) *gradient = 2 * away;
  return away.squaredNorm();
}

SearchTask TaskFor(SearchAlgorithm algorithm) {
  return {.algorithm = algorithm,
          .lower = Eigen::Vector2d::Zero(),
          .upper = Eigen::Vector2d::Ones(),
          .start = Eigen::Vector2d(0.9, 0.1),
          .max_evaluations = 600};
}

// 600 evaluations bring the slowest, DIRECT-L, within a few per cent of the box.
TEST(NloptMinimize, EveryAlgorithmFindsABowlsBottomTheSameWayTwice) {
  for (const auto algorithm : {SearchAlgorithm::kLbfgs, SearchAlgorithm::kBobyqa,
                               SearchAlgorithm::kNelderMead, SearchAlgorithm::kDirectL}) {
    const Minimum first = Minimize(Bowl, TaskFor(algorithm));
    const Minimum second = Minimize(Bowl, TaskFor(algorithm));
    EXPECT_LT(first.value, 4e-3) << static_cast<int>(algorithm);
    EXPECT_LE(first.num_evaluations, 610);  // some finish the step they are in
    EXPECT_EQ(first.point, second.point) << static_cast<int>(algorithm);
  }
}

TEST(NloptMinimize, AnExceptionEndsTheSearchAndReachesTheCaller) {
  int calls = 0;
  const SearchFunction function = [&](const Eigen::VectorXd&, Eigen::VectorXd*) -> double {
    if (++calls == 3) throw std::runtime_error("no more");
    return calls;
  };
  EXPECT_THROW(Minimize(function, TaskFor(SearchAlgorithm::kNelderMead)), std::runtime_error);
  EXPECT_EQ(calls, 3);
}

TEST(NloptMinimize, NanIsAvoidedNotReturned) {
  const SearchFunction half = [](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
    return x[0] > 0.5 ? std::nan("") : Bowl(x, gradient);
  };
  const Minimum found = Minimize(half, TaskFor(SearchAlgorithm::kDirectL));
  EXPECT_LT(found.value, 1e-3);
}

}  // namespace nlopt_minimize_test
}  // namespace talus::surrogate
