#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::surrogate {
namespace scale_factors_test {

constexpr double kNoise = 0.02;

double Fine(double x) { return std::sin(3 * x); }
double Discrepancy(double x) { return 0.5 - 0.8 * x; }

// Two scale factors: `num_coarse` evaluations with growth 1, `num_fine` at the target.
Evaluations TwoLevels(int num_coarse, int num_fine) {
  const int n = num_coarse + num_fine;
  Evaluations data{.points = Eigen::MatrixXd(n, 1),
                   .values = Eigen::VectorXd(n),
                   .growth = Eigen::VectorXd(n),
                   .level = Eigen::VectorXi(n)};
  base::Random random(7, base::Stream("two levels"));
  for (int i = 0; i < n; ++i) {
    const bool coarse = i < num_coarse;
    const double x = coarse ? (i + 0.5) / num_coarse : (i - num_coarse + 0.5) / num_fine;
    data.points(i, 0) = x;
    data.growth[i] = coarse ? 1 : 0;
    data.level[i] = coarse ? 0 : 1;
    data.values[i] = Fine(x) + (coarse ? Discrepancy(x) : 0) + kNoise * random.Normal();
  }
  return data;
}

GaussianProcessOptions Options() {
  return {
      .warp_inputs = true,
      .priors = PriorsOfOutputs({{.median = 0.1, .log_sd = 0.7}, {.median = 0.1, .log_sd = 0.7}}),
      .effort = {.num_starts = 1, .num_searches = 2, .max_evaluations = 50}};
}

double RmsError(const GaussianProcess& process) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(50, 0.02, 0.98);
  const Predictions at_target = process.PredictAll(x);
  double sum = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    sum += std::pow(at_target.mean[i] - Fine(x[i]), 2);
  }
  return std::sqrt(sum / 50);
}

TEST(ScaleFactors, CoarseEvaluationsAndThreeFineOnesPredictTheTarget) {
  const auto both = GaussianProcess::Fit(TwoLevels(12, 3), Options());
  // Three fine points alone miss a sine's bend by several times the noise; coarse points alone miss
  // the target by the discrepancy, 0.5 at one end.
  EXPECT_LT(RmsError(both), 0.05);
  Evaluations fine = TwoLevels(0, 3);
  EXPECT_GT(RmsError(GaussianProcess::Fit(fine, Options())), 2 * RmsError(both));
}

// Coarse evaluations of another function altogether, too rough for the points to follow.
TEST(ScaleFactors, CoarseEvaluationsThatTellNothingDoLittleHarm) {
  constexpr int kFine = 5;
  Evaluations data = TwoLevels(20, kFine);
  for (int i = 0; i < 20; ++i) {
    const double rough = 17 * data.points(i, 0);
    data.values[i] = Fine(rough - std::floor(rough));
  }
  const auto both = GaussianProcess::Fit(data, Options());
  const auto fine = GaussianProcess::Fit(TwoLevels(0, kFine), Options());
  // Fine ones alone miss by about their noise. Without a decay and a length of its own for the
  // discrepancy both together missed by twice as much.
  EXPECT_LT(RmsError(both), RmsError(fine) + kNoise / 2);
}

TEST(ScaleFactors, CoarseEvaluationsAloneLeaveTheDiscrepancyOpen) {
  Evaluations coarse = TwoLevels(12, 0);
  const auto process = GaussianProcess::Fit(coarse, Options());
  const Eigen::MatrixXd x = Eigen::MatrixXd::Constant(1, 1, 0.5);
  // The prior sd of the discrepancy is 0.3 of the spread and more: the target is not known better.
  EXPECT_GT(std::sqrt(process.PredictAll(x).variance[0]),
            4 * std::sqrt(process.PredictAll(x, 1).variance[0]));
}

TEST(ScaleFactors, LeaveOneOutIsThePredictionFromTheOthers) {
  const Evaluations all = TwoLevels(8, 4);
  const auto process = GaussianProcess::Fit(all, Options());
  const Predictions left_out = process.LeaveOneOut();
  constexpr Eigen::Index kLeft = 9;  // a fine one
  Evaluations others = all;
  const Eigen::Index last = all.values.size() - 1;
  others.points.row(kLeft) = all.points.row(last);
  others.values[kLeft] = all.values[last];
  others.points.conservativeResize(last, Eigen::NoChange);
  others.growth.conservativeResize(last);
  others.level.conservativeResize(last);
  others.values.conservativeResize(last);
  GaussianProcessOptions frozen = Options();
  frozen.frozen = process.state();
  const auto without = GaussianProcess::Fit(others, frozen);
  const Predictions at = without.PredictAll(all.points.row(kLeft));
  // Both are exact; the jitter of 1e-10 and rounding remain.
  EXPECT_NEAR(left_out.mean[kLeft], at.mean[0], 1e-6);
  EXPECT_NEAR(left_out.variance[kLeft], at.variance[0] + process.noise_variance(1), 1e-7);
}

// Against the variance once the evaluation is there, at its own place and elsewhere.
TEST(ScaleFactors, AnEvaluationTakesFromTheVarianceWhatTheCovariancesSay) {
  for (const double growth : {0.0, 1.0}) {
    auto process = GaussianProcess::Fit(TwoLevels(8, 3), Options());
    const Site site{
        .x = Eigen::VectorXd::Constant(1, 0.3), .growth = growth, .level = growth > 0 ? 0 : 1};
    const Eigen::MatrixXd points = Eigen::Vector3d(0.3, 0.35, 0.9);
    const AnchorPoints anchors = process.Anchor(points);
    const Covariances at = process.PosteriorCovariances(anchors, site.x.transpose(), growth);
    const Eigen::ArrayXd expected =
        anchors.variance.array() -
        at.between.col(0).array().square() / (at.variance[0] + process.noise_variance(site.level));
    process.AddFantasy(site);
    const Predictions after = process.PredictAll(points);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(after.variance[j], expected[j], 1e-6) << growth << j;
  }
}

// Replicates at one scale factor are one point with its mean; the same place at another is not.
TEST(ScaleFactors, ReplicatesArePooledAtTheirOwnScaleFactor) {
  Evaluations told = TwoLevels(6, 3);
  told.points(1, 0) = told.points(0, 0);
  told.points(8, 0) = told.points(0, 0);
  const PooledData data = Pool(told, 2);
  EXPECT_EQ(data.size(), 8);
  EXPECT_EQ(data.counts[0], 2);
  EXPECT_EQ(data.values[0], (told.values[0] + told.values[1]) / 2);
  EXPECT_EQ(data.num_extra, Eigen::Vector2d(1, 0));
  EXPECT_NEAR(data.sum_of_squares[0], std::pow(told.values[0] - told.values[1], 2) / 2, 1e-15);
}

}  // namespace scale_factors_test
}  // namespace talus::surrogate
