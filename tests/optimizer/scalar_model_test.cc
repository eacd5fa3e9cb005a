#include "optimizer/search/scalar_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/designs/r_sequence.h"

namespace talus::optimizer {
namespace scalar_model_test {

// A bowl that steepens outwards, over four decades, whose lowest point was evaluated twice as a
// search does it, in units of 1 / `unit`.
History Bowl(double unit) {
  History history{.points = RSequence(22, 2, 1), .values = Eigen::VectorXd(22), .failed = {}};
  const auto value = [&](Eigen::Index i) {
    const Eigen::RowVector2d from_bottom = history.points.row(i) - Eigen::RowVector2d(0.4, 0.6);
    return unit * std::expm1(12 * from_bottom.squaredNorm());
  };
  for (Eigen::Index i = 0; i < 22; ++i) history.values[i] = value(i);
  Eigen::Index best = 0;
  history.values.minCoeff(&best);
  history.points.row(21) = history.points.row(best);
  history.values[21] = history.values[best];
  return history;
}

// The density of a value has a unit, and both evaluations of the best point count in it.
TEST(ScalarFitter, ChoosesTheSameTransformInEveryUnit) {
  for (const FitFor purpose : {FitFor::kSearch, FitFor::kAnswer}) {
    const double delta = ScalarFitter(1).Fit(Bowl(1), true, purpose).transform.delta;
    ASSERT_GT(delta, 0);
    for (const double unit : {1e-6, 1e6}) {
      const ScalarFit fit = ScalarFitter(1).Fit(Bowl(unit), true, purpose);
      EXPECT_NEAR(fit.transform.delta / unit, delta, 1e-9 * delta) << unit;
    }
  }
}

}  // namespace scalar_model_test
}  // namespace talus::optimizer
