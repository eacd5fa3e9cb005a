// Every analytic gradient of surrogate/ against central differences.
//
// With step h = 1e-5 a central difference of a function of order one errs by h² ~ 1e-10 from the
// third derivative and by 1e-16 / h ~ 1e-11 from rounding; the tolerances leave room for
// derivatives and for the condition of K. A wrong factor or sign shows in the first digit.
#include <gtest/gtest.h>

#include <functional>
#include <tuple>

#include "base/random.h"
#include "surrogate/process/covariance.h"
#include "surrogate/process/gaussian_process.h"
#include "surrogate/process/likelihood.h"
#include "surrogate/process/warp.h"

namespace talus::surrogate {
namespace gradients_test {

constexpr double kStep = 1e-5;

Eigen::MatrixXd RandomPoints(int rows, int cols, std::uint64_t seed) {
  base::Random random(seed, base::Stream("gradient test"));
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return random.Uniform(); });
}

Eigen::VectorXd Waves(const Eigen::MatrixXd& points) {
  return (points * Eigen::VectorXd::LinSpaced(points.cols(), 2, 5)).array().sin() +
         points.col(0).array().square();
}

Eigen::VectorXd Differences(const std::function<double(const Eigen::VectorXd&)>& function,
                            const Eigen::VectorXd& x) {
  Eigen::VectorXd result(x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Eigen::VectorXd up = x;
    Eigen::VectorXd down = x;
    up[k] += kStep;
    down[k] -= kStep;
    result[k] = (function(up) - function(down)) / (2 * kStep);
  }
  return result;
}

class Gradients : public testing::TestWithParam<std::tuple<Kernel, Trend, bool>> {
 protected:
  Kernel kernel() const { return std::get<0>(GetParam()); }
  Trend trend() const { return std::get<1>(GetParam()); }
  bool warps() const { return std::get<2>(GetParam()); }
  double trend_sd() const { return trend() == Trend::kQuadratic ? 0.8 : 0; }
};

TEST_P(Gradients, CovarianceAndItsDiagonal) {
  Eigen::VectorXd length(3);
  length << 0.3, 0.7, 1.5;
  const Covariance covariance(kernel(), {.length = length, .signal = 1.3, .trend = trend_sd()});
  const Sites others = Sites::At(RandomPoints(3, 5, 1), 0);
  const Eigen::VectorXd x = RandomPoints(3, 1, 2);
  const Eigen::MatrixXd gradient = covariance.Gradient(x, others);
  for (Eigen::Index j = 0; j < others.columns.cols(); ++j) {
    const auto at = [&](const Eigen::VectorXd& p) {
      return covariance.At(p.data(), others.columns.col(j).data());
    };
    EXPECT_LT((gradient.col(j) - Differences(at, x)).norm(), 1e-7);
  }
  const auto diagonal = [&](const Eigen::VectorXd& p) { return covariance.At(p.data(), p.data()); };
  EXPECT_LT((covariance.DiagonalGradient(x) - Differences(diagonal, x)).norm(), 1e-7);
}

TEST_P(Gradients, LikelihoodAndPriorWithReplicates) {
  Eigen::MatrixXd points = RandomPoints(14, 3, 3);
  points.row(13) = points.row(2);
  points.row(12) = points.row(2);
  Eigen::VectorXd values = Waves(points);
  values[13] += 0.2;
  const PooledData data = Pool({points, values});
  const HyperLayout layout{.dimension = 3,
                           .free_trend = trend() == Trend::kQuadratic,
                           .free_noise = true,
                           .free_warp = warps()};
  const ThetaPrior prior({}, layout);
  Eigen::VectorXd theta = prior.median;
  for (Eigen::Index k = 0; k < theta.size(); ++k) theta[k] += 0.3 * (k % 3) - 0.4;
  Eigen::VectorXd gradient;
  const double likelihood = LogLikelihood(data, kernel(), layout, theta, &gradient);
  ASSERT_TRUE(std::isfinite(likelihood));
  const auto at = [&](const Eigen::VectorXd& t) {
    return LogLikelihood(data, kernel(), layout, t, nullptr);
  };
  EXPECT_LT((gradient - Differences(at, theta)).norm(), 1e-6 * (1 + gradient.norm()));

  Eigen::VectorXd prior_gradient = Eigen::VectorXd::Zero(theta.size());
  prior.LogDensity(theta, &prior_gradient);
  const auto density = [&](const Eigen::VectorXd& t) { return prior.LogDensity(t, nullptr); };
  EXPECT_LT((prior_gradient - Differences(density, theta)).norm(), 1e-7);
}

// Three scale factors of which one has replicates, and every hyper-parameter free.
TEST_P(Gradients, LikelihoodOfSeveralScaleFactors) {
  Evaluations told{.points = RandomPoints(18, 3, 6),
                   .values = {},
                   .growth = Eigen::VectorXd(18),
                   .level = Eigen::VectorXi(18)};
  for (Eigen::Index i = 0; i < 18; ++i) {
    told.level[i] = i < 9 ? 0 : (i < 14 ? 1 : 2);
    told.growth[i] = 1 - 0.5 * told.level[i];
  }
  told.points.row(8) = told.points.row(1);
  told.values = Waves(told.points) + told.growth;
  told.values[8] += 0.3;
  const PooledData data = Pool(told, 3);
  const HyperLayout layout{.dimension = 3,
                           .num_levels = 3,
                           .free_trend = trend() == Trend::kQuadratic,
                           .free_noise = true,
                           .free_warp = warps(),
                           .has_scale = true};
  const HyperPriors priors{.noise = std::vector<LogNormal>(3, {.median = 0.1, .log_sd = 1})};
  Eigen::VectorXd theta = ThetaPrior(priors, layout).median;
  for (Eigen::Index k = 0; k < theta.size(); ++k) theta[k] += 0.3 * (k % 3) - 0.25;
  Eigen::VectorXd gradient;
  ASSERT_TRUE(std::isfinite(LogLikelihood(data, kernel(), layout, theta, &gradient)));
  const auto at = [&](const Eigen::VectorXd& t) {
    return LogLikelihood(data, kernel(), layout, t, nullptr);
  };
  EXPECT_LT((gradient - Differences(at, theta)).norm(), 1e-6 * (1 + gradient.norm()));
}

TEST_P(Gradients, PredictedMeanAndVariance) {
  const Eigen::MatrixXd points = RandomPoints(20, 3, 4);
  const auto process =
      GaussianProcess::Fit({points, 50 + 7 * Waves(points).array()},
                           {.kernel = kernel(), .trend = trend(), .warp_inputs = warps()});
  const Eigen::VectorXd x = RandomPoints(3, 1, 5);
  const PredictionGradient gradient = process.PredictWithGradient(x);
  const auto mean = [&](const Eigen::VectorXd& p) { return process.Predict(p).mean; };
  const auto variance = [&](const Eigen::VectorXd& p) { return process.Predict(p).variance; };
  // Values span 20: absolute derivatives of order 100, so 1e-5 is seven digits.
  EXPECT_LT((gradient.mean - Differences(mean, x)).norm(), 1e-5);
  EXPECT_LT((gradient.variance - Differences(variance, x)).norm(), 1e-5);
  EXPECT_EQ(gradient.value.mean, process.Predict(x).mean);
}

INSTANTIATE_TEST_SUITE_P(
    All, Gradients,
    testing::Combine(testing::Values(Kernel::kMatern52, Kernel::kSquaredExponential),
                     testing::Values(Trend::kConstant, Trend::kQuadratic), testing::Bool()));

// Strengths on both sides of the switch to the series at 1e-3; the differences do not step over it.
TEST(Warp, SlopesAreThoseOfTheMapAndItsEndsStay) {
  for (const double strength : {-4.0, -1.02e-3, -0.98e-3, 0.0, 0.98e-3, 1.02e-3, 2.5}) {
    EXPECT_NEAR(WarpAt(0, strength).value, 0, 1e-15);
    EXPECT_NEAR(WarpAt(1, strength).value, 1, 1e-15);
    const Eigen::Vector2d at(0.3, strength);
    const auto value = [](const Eigen::VectorXd& x) { return WarpAt(x[0], x[1]).value; };
    const Eigen::VectorXd slopes = Differences(value, at);
    EXPECT_NEAR(WarpAt(0.3, strength).slope, slopes[0], 1e-8) << strength;
    EXPECT_NEAR(WarpAt(0.3, strength).warp_slope, slopes[1], 1e-8) << strength;
  }
}

}  // namespace gradients_test
}  // namespace talus::surrogate
