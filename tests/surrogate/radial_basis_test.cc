#include "surrogate/process/radial_basis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace talus::surrogate {
namespace radial_basis_test {

double Surface(const Eigen::VectorXd& x) { return std::sin(3 * x[0]) + x[0] * x[1] * x[1]; }

struct Data {
  Eigen::MatrixXd points;
  Eigen::VectorXd values;
};

Data MakeData(int size, double noise) {
  base::Random random(3, base::Stream("radial basis test"));
  Data data{Eigen::MatrixXd(size, 2), Eigen::VectorXd(size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    data.points.row(i) << random.Uniform(), random.Uniform();
    data.values[i] = Surface(data.points.row(i)) + noise * random.Normal();
  }
  return data;
}

class BothFunctions : public testing::TestWithParam<RadialFunction> {};

TEST_P(BothFunctions, InterpolatesSmoothValuesAndPredictsBetweenThem) {
  const Data data = MakeData(40, 0);
  const RadialBasis basis = RadialBasis::Fit(data.points, data.values, GetParam());
  EXPECT_LE(basis.smoothing(), 1e-6);
  for (Eigen::Index i = 0; i < data.values.size(); ++i) {
    EXPECT_NEAR(basis.Predict(data.points.row(i)), data.values[i], 1e-4);
  }
  const Eigen::Vector2d x(0.45, 0.55);
  EXPECT_NEAR(basis.Predict(x), Surface(x), 0.02);  // of a surface that spans 2, 40 points
}

TEST_P(BothFunctions, ReproducesLinearFunctionsEverywhere) {
  Data data = MakeData(12, 0);
  const Eigen::Vector2d slope(2, -3);
  data.values = (data.points * slope).array() + 1.5;
  const RadialBasis basis = RadialBasis::Fit(data.points, data.values, GetParam());
  const Eigen::Vector2d x(0.1, 0.95);
  EXPECT_NEAR(basis.Predict(x), slope.dot(x) + 1.5, 1e-9);  // rounding
  EXPECT_LT((basis.Gradient(x) - slope).norm(), 1e-8);
}

TEST_P(BothFunctions, GradientIsThatOfDifferences) {
  const Data data = MakeData(20, 0.1);
  const RadialBasis basis = RadialBasis::Fit(data.points, data.values, GetParam());
  const Eigen::Vector2d x(0.31, 0.72);
  const Eigen::VectorXd gradient = basis.Gradient(x);
  for (int k = 0; k < 2; ++k) {
    Eigen::Vector2d step = Eigen::Vector2d::Zero();
    step[k] = 1e-5;
    // Central differences are off by the third derivative times 1e-10.
    EXPECT_NEAR(gradient[k], (basis.Predict(x + step) - basis.Predict(x - step)) / 2e-5, 1e-6);
  }
}

TEST_P(BothFunctions, SmoothsNoiseAwayAndLeavingOutIsRefitting) {
  const Data data = MakeData(40, 0.3);
  const RadialBasis basis = RadialBasis::Fit(data.points, data.values, GetParam());
  EXPECT_GT(basis.smoothing(), 0);
  double error = 0;
  for (Eigen::Index i = 0; i < 40; ++i) {
    error += std::pow(basis.Predict(data.points.row(i)) - Surface(data.points.row(i)), 2) / 40;
  }
  EXPECT_LT(std::sqrt(error), 0.2);  // a single value is off by 0.3
  const RadialBasis fewer = RadialBasis::Fit(data.points.topRows(39), data.values.head(39),
                                             GetParam(), basis.smoothing());
  EXPECT_NEAR(basis.LeaveOneOut()[39], fewer.Predict(data.points.row(39)), 1e-8);  // rounding
}

TEST_P(BothFunctions, StandsDuplicatesAndTooFewPoints) {
  Data data = MakeData(10, 0.1);
  data.points.row(3) = data.points.row(4);
  const RadialBasis basis = RadialBasis::Fit(data.points, data.values, GetParam());
  EXPECT_TRUE(std::isfinite(basis.Predict(Eigen::Vector2d(0.5, 0.5))));
  EXPECT_GT(basis.smoothing(), 0);  // two values at one place cannot both be met
  const RadialBasis one = RadialBasis::Fit(data.points.topRows(1), data.values.head(1), GetParam());
  EXPECT_EQ(one.Predict(Eigen::Vector2d(0.9, 0.1)), data.values[0]);
}

// A plane through d + 1 points leaves nothing over to choose a smoothing by: rounding chose it, and
// two values became a constant, two others a line.
TEST_P(BothFunctions, OfTwoPointsOnALineOnlyTheScaleOfTheirValuesMatters) {
  const Eigen::MatrixXd points = Eigen::Vector2d(0.2, 0.9);
  const auto share = [&](const Eigen::Vector2d& values) {
    const RadialBasis basis = RadialBasis::Fit(points, values, GetParam());
    const double there = basis.Predict(Eigen::VectorXd::Constant(1, 0.3));
    return (there - values[1]) / (values[0] - values[1]);
  };
  EXPECT_NEAR(share({3.52, 1.18}), share({3.10, 2.43}), 1e-9);  // rounding
}

INSTANTIATE_TEST_SUITE_P(All, BothFunctions,
                         testing::Values(RadialFunction::kCubic, RadialFunction::kThinPlate));

}  // namespace radial_basis_test
}  // namespace talus::surrogate
