#include "surrogate/fidelity/fidelity_process.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace talus::surrogate {
namespace {

constexpr double kNoise = 0.02;

double Fine(double x) { return std::sin(3 * x); }
double Discrepancy(double x) { return 0.5 - 0.8 * x; }

// Two scale factors: `num_coarse` evaluations with growth 1, `num_fine` at the target.
FidelityData TwoLevels(int num_coarse, int num_fine) {
  const int n = num_coarse + num_fine;
  FidelityData data{.points = Eigen::MatrixXd(1, n),
                    .growth = Eigen::VectorXd(n),
                    .level = Eigen::VectorXi(n),
                    .values = Eigen::VectorXd(n)};
  base::Random random(7, base::Stream("two levels"));
  for (int i = 0; i < n; ++i) {
    const bool coarse = i < num_coarse;
    const double x = coarse ? (i + 0.5) / num_coarse : (i - num_coarse + 0.5) / num_fine;
    data.points(0, i) = x;
    data.growth[i] = coarse ? 1 : 0;
    data.level[i] = coarse ? 0 : 1;
    data.values[i] = Fine(x) + (coarse ? Discrepancy(x) : 0) + kNoise * random.Normal();
  }
  return data;
}

const FidelityFitOptions kOptions{.noise_median = Eigen::Vector2d(0.1, 0.1),
                                  .noise_log_sd = Eigen::Vector2d(0.7, 0.7)};

double RmsError(const FidelityProcess& process) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(50, 0.02, 0.98);
  const Predictions at_target = process.Predict(x, 0);
  double sum = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    sum += std::pow(at_target.mean[i] - Fine(x[i]), 2);
  }
  return std::sqrt(sum / 50);
}

TEST(FidelityProcess, GradientOfLogPosteriorIsThatOfDifferences) {
  const FidelityData data = TwoLevels(6, 3);
  const FidelityLayout layout{.dimension = 1, .num_levels = 2};
  Eigen::VectorXd theta(layout.size());
  theta << -0.3, 0.1, -0.5, -0.8, -2.0, -1.7, 0.4, 0.6, -0.3;
  const Eigen::VectorXd median = Eigen::VectorXd::Zero(layout.size());
  const Eigen::VectorXd sd = Eigen::VectorXd::Constant(layout.size(), 1.3);
  Eigen::VectorXd gradient;
  FidelityLogPosterior(data, layout, median, sd, theta, &gradient);
  for (Eigen::Index k = 0; k < theta.size(); ++k) {
    Eigen::VectorXd up = theta;
    Eigen::VectorXd down = theta;
    constexpr double kStep = 1e-5;
    up[k] += kStep;
    down[k] -= kStep;
    const double slope = (FidelityLogPosterior(data, layout, median, sd, up, nullptr) -
                          FidelityLogPosterior(data, layout, median, sd, down, nullptr)) /
                         (2 * kStep);
    // Central differences of a sum of some hundreds: rounding leaves 1e-16 * 1e2 / 1e-5.
    EXPECT_NEAR(gradient[k], slope, 1e-5 * (1 + std::abs(slope))) << "hyper-parameter " << k;
  }
}

TEST(FidelityProcess, CoarseEvaluationsAndThreeFineOnesPredictTheTarget) {
  const auto both = FidelityProcess::Fit(TwoLevels(12, 3), kOptions);
  // Three fine points alone miss a sine's bend by several times the noise; coarse points alone miss
  // the target by the discrepancy, 0.5 at one end.
  EXPECT_LT(RmsError(both), 0.05);
  FidelityData fine = TwoLevels(0, 3);
  EXPECT_GT(RmsError(FidelityProcess::Fit(fine, kOptions)), 2 * RmsError(both));
}

// Coarse evaluations of another function altogether, too rough for the points to follow.
TEST(FidelityProcess, CoarseEvaluationsThatTellNothingDoLittleHarm) {
  constexpr int kFine = 5;
  FidelityData data = TwoLevels(20, kFine);
  for (int i = 0; i < 20; ++i) {
    const double rough = 17 * data.points(0, i);
    data.values[i] = Fine(rough - std::floor(rough));
  }
  const auto both = FidelityProcess::Fit(data, kOptions);
  const auto fine = FidelityProcess::Fit(TwoLevels(0, kFine), kOptions);
  // Fine ones alone miss by about their noise. Without a decay and a length of its own for the
  // discrepancy both together missed by twice as much.
  EXPECT_LT(RmsError(both), RmsError(fine) + kNoise / 2);
}

TEST(FidelityProcess, CoarseEvaluationsAloneLeaveTheDiscrepancyOpen) {
  FidelityData coarse = TwoLevels(12, 0);
  const auto process = FidelityProcess::Fit(coarse, kOptions);
  const Eigen::MatrixXd x = Eigen::MatrixXd::Constant(1, 1, 0.5);
  // The prior sd of the discrepancy is 0.3 of the spread and more: the target is not known better.
  EXPECT_GT(std::sqrt(process.Predict(x, 0).variance[0]),
            4 * std::sqrt(process.Predict(x, 1).variance[0]));
}

TEST(FidelityProcess, LeaveOneOutIsThePredictionFromTheOthers) {
  const FidelityData all = TwoLevels(8, 4);
  const auto process = FidelityProcess::Fit(all, kOptions);
  const Predictions left_out = process.LeaveOneOut();
  constexpr Eigen::Index kLeft = 9;  // a fine one
  FidelityData others = all;
  const Eigen::Index last = all.values.size() - 1;
  others.points.col(kLeft) = all.points.col(last);
  others.values[kLeft] = all.values[last];
  others.points.conservativeResize(Eigen::NoChange, last);
  others.growth.conservativeResize(last);
  others.level.conservativeResize(last);
  others.values.conservativeResize(last);
  FidelityFitOptions frozen = kOptions;
  frozen.frozen = process.state();
  const auto without = FidelityProcess::Fit(others, frozen);
  const Predictions at = without.Predict(all.points.col(kLeft).transpose(), 0);
  // Both are exact; the jitter of 1e-10 and rounding remain.
  EXPECT_NEAR(left_out.mean[kLeft], at.mean[0], 1e-6);
  EXPECT_NEAR(left_out.variance[kLeft], at.variance[0] + process.noise_variance(1), 1e-7);
}

// Against the variance once the evaluation is there, at its own place and elsewhere.
TEST(FidelityProcess, TeachingIsWhatAnEvaluationTakesFromTheVariance) {
  for (const double growth : {0.0, 1.0}) {
    auto process = FidelityProcess::Fit(TwoLevels(8, 3), kOptions);
    const FidelityPoint site{.x = Eigen::VectorXd::Constant(1, 0.3), .growth = growth};
    const int level = growth > 0 ? 0 : 1;
    const Eigen::MatrixXd points = Eigen::Vector3d(0.3, 0.35, 0.9);
    const auto watched = process.Watch(points);
    const auto teaching = process.TeachingOf(watched, site);
    const Eigen::ArrayXd expected =
        watched.variance.array() - teaching.covariance.array().square() /
                                       (teaching.site_variance + process.noise_variance(level));
    process.AddFantasy(site, level);
    const Predictions after = process.Predict(points, 0);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(after.variance[j], expected[j], 1e-6) << growth << j;
  }
}

}  // namespace
}  // namespace talus::surrogate
