#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/posterior/sample_statistics.h"

namespace talus::optimizer {
namespace moved_parameters_test {

// Even draws of a coordinate between two values: sd (high - low)/√12.
Eigen::VectorXd Even(double low, double high) {
  constexpr int kDraws = 1000;
  return Eigen::VectorXd::LinSpaced(kDraws, low, high);
}

TEST(MovedParameters, WhatIsAskedForCountsOnce) {
  Eigen::MatrixXd draws(1000, 2);
  draws << Even(0, 1), Even(0.3, 0.4);
  EXPECT_EQ(MovedParameters({.num_parameters = 2}, draws), 2);
}

TEST(MovedParameters, ANuisanceCountsByTheShareOfItsPriorsVarianceThatTheDataTake) {
  Eigen::MatrixXd draws(1000, 2);
  draws << Even(0, 1), Even(0.2, 0.7);
  // Even over half of its range: a quarter of the variance is left.
  EXPECT_NEAR(MovedParameters({.num_parameters = 2, .nuisances = {1}}, draws), 1.75, 0.01);
  Domain known{.num_parameters = 2, .nuisances = {1}};
  known.prior.Add(1, {.low = 0, .high = 1}, {.mean = 0.45, .sd = 0.05});
  EXPECT_EQ(MovedParameters(known, draws), 1);  // wider than its prior: not moved
  // As narrow as a narrow prior is: not moved either. Of 2000 draws the sd is within 3 %.
  Domain narrow{.num_parameters = 2, .nuisances = {1}};
  narrow.prior.Add(1, {.low = 0, .high = 1}, {.mean = 0.45, .sd = 0.01});
  draws.col(1) = Even(0.45 - 0.01 * std::sqrt(3.0), 0.45 + 0.01 * std::sqrt(3.0));
  EXPECT_NEAR(MovedParameters(narrow, draws), 1, 0.1);
}

}  // namespace moved_parameters_test
}  // namespace talus::optimizer
