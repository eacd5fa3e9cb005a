#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/designs/r_sequence.h"
#include "optimizer/posterior/sobol_indices.h"
#include "optimizer/search/describe_minimum.h"
#include "optimizer/search/scalar_model.h"

namespace talus::optimizer {
namespace answer_test {

// f = |x - m|² with an uncertainty of the minimiser that is known: draws are |x - m - e|² with
// e ~ N(0, sd²) in each coordinate.
class KnownBowl : public ObjectiveModel {
 public:
  KnownBowl(Eigen::VectorXd minimum, Eigen::VectorXd sd, double noise)
      : minimum_(std::move(minimum)), sd_(std::move(sd)), noise_(noise) {}

  Moments Predict(const Eigen::MatrixXd& points) const override {
    const Eigen::VectorXd mean = (points.rowwise() - minimum_.transpose()).rowwise().squaredNorm();
    return {mean, Eigen::VectorXd::Constant(points.rows(), 0.01)};
  }
  Eigen::MatrixXd Draw(const Eigen::MatrixXd& points, int num_draws,
                       base::Random random) const override {
    Eigen::MatrixXd draws(num_draws, points.rows());
    for (int i = 0; i < num_draws; ++i) {
      Eigen::VectorXd at = minimum_;
      for (Eigen::Index k = 0; k < at.size(); ++k) at[k] += sd_[k] * random.Normal();
      draws.row(i) = (points.rowwise() - at.transpose()).rowwise().squaredNorm().transpose();
    }
    return draws;
  }
  double NoiseSd(const Eigen::VectorXd&) const override { return noise_; }

 private:
  Eigen::VectorXd minimum_;
  Eigen::VectorXd sd_;
  double noise_;
};

const Eigen::Vector2d kMinimum(0.4, 0.55);

// Both coordinates of 90 % of normal pairs lie within 1.95 sd: 0.9 = 0.9487². 400 draws give a
// quantile so far out to 0.13 sd, and minimisers fall on 400 places, which costs about as much
// again.
TEST(Answer, CredibleRangesAreThoseOfTheMinimiser) {
  const KnownBowl model(kMinimum, Eigen::Vector2d(0.05, 0.02), 0);
  const Answer answer = DescribeMinimum(model, {.num_parameters = 2}, kMinimum, {});
  EXPECT_NEAR(answer.credible[0].low, 0.4 - 1.95 * 0.05, 0.02);
  EXPECT_NEAR(answer.credible[0].high, 0.4 + 1.95 * 0.05, 0.02);
  EXPECT_NEAR(answer.credible[1].low, 0.55 - 1.95 * 0.02, 0.01);
  EXPECT_NEAR(answer.credible[1].high, 0.55 + 1.95 * 0.02, 0.01);
  EXPECT_NEAR(answer.correlation(0, 1), 0, 0.2);  // 400 draws: 4 standard errors
  EXPECT_EQ(answer.correlation(1, 1), 1);
}

// Ties: |x - m|² <= n, a disc of area π n. A lattice of 4000 counts area to about 1 %.
TEST(Answer, TiedVolumeIsTheAreaWithinTheNoiseHoweverSmall) {
  for (const double noise : {0.04, 1e-4, 1e-8}) {
    const KnownBowl model(kMinimum, Eigen::Vector2d(0.01, 0.01), noise);
    const Answer answer = DescribeMinimum(model, {.num_parameters = 2}, kMinimum, {});
    EXPECT_NEAR(answer.tied_volume / (M_PI * noise), 1, 0.1) << noise;
    ASSERT_FALSE(answer.tied.empty());
    for (const Eigen::VectorXd& point : answer.tied) {
      EXPECT_LE((point - kMinimum).squaredNorm(), noise);
    }
    // The first tied point is the farthest: nearly on the rim.
    EXPECT_GT((answer.tied[0] - kMinimum).norm(), 0.8 * std::sqrt(noise));
  }
}

TEST(Answer, WarnsOfBoundsAndKeepsToTheDomain) {
  const Eigen::Vector2d corner(0.0, 0.999);
  const KnownBowl model(corner, Eigen::Vector2d(0.05, 0.05), 0.01);
  const Domain domain{.num_parameters = 2,
                      .feasible = [](const Eigen::VectorXd& x) { return x[0] <= 0.05; }};
  const Answer answer = DescribeMinimum(model, domain, corner, {});
  ASSERT_EQ(answer.warnings.size(), 2u);
  EXPECT_EQ(answer.warnings[0].parameter, 0);
  EXPECT_FALSE(answer.warnings[0].is_upper);
  EXPECT_EQ(answer.warnings[1].parameter, 1);
  EXPECT_TRUE(answer.warnings[1].is_upper);
  for (const Eigen::VectorXd& point : answer.tied) EXPECT_LE(point[0], 0.05);
  EXPECT_LE(answer.credible[0].high, 0.05);
}

// Every evaluation above x = 0.5 fails, and draws have their minima on both sides.
TEST(Answer, RangesAndTiesStayWhereEvaluationsWork) {
  const Eigen::Vector2d minimum(0.45, 0.5);
  const KnownBowl model(minimum, Eigen::Vector2d(0.15, 0.05), 0.1);
  const Eigen::MatrixXd points = RSequence(120, 2, 1);
  std::vector<Eigen::Index> good, bad;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    (points(i, 0) > 0.5 ? bad : good).push_back(i);
  }
  const Feasibility feasibility(
      History{.points = points(good, Eigen::all),
              .values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(good.size())),
              .failed = points(bad, Eigen::all)});
  const Domain cube{.num_parameters = 2};
  // The border of the success model is known to half the points' distance, 0.05.
  const Answer answer = DescribeMinimum(model, cube, minimum, {.feasibility = &feasibility});
  EXPECT_LT(answer.credible[0].high, 0.58);
  for (const Eigen::VectorXd& point : answer.tied) EXPECT_LT(point[0], 0.58);
  EXPECT_GT(DescribeMinimum(model, cube, minimum, {}).credible[0].high, 0.65);
}

// f = x + 2 y + 3 x z over the cube, worked out by hand: V_x = (1 + 3/2)²/12, V_y = 4/12,
// V_z = (3/2)²/12, V_xz = 9/144. The lattice of 512 integrates to about 1 %.
TEST(SobolIndices, EqualThoseOfAPolynomial) {
  const SobolIndices indices = EstimateSobolIndices(
      [](const Eigen::MatrixXd& p) -> Eigen::VectorXd {
        return p.col(0).array() + 2 * p.col(1).array() + 3 * p.col(0).array() * p.col(2).array();
      },
      {.dimension = 3, .num_base = 2048});
  const double x = 6.25 / 12;
  const double y = 4.0 / 12;
  const double z = 2.25 / 12;
  const double xz = 9.0 / 144;
  const double all = x + y + z + xz;
  EXPECT_NEAR(indices.first[0], x / all, 0.03);
  EXPECT_NEAR(indices.first[1], y / all, 0.03);
  EXPECT_NEAR(indices.first[2], z / all, 0.03);
  EXPECT_NEAR(indices.total[0], (x + xz) / all, 0.03);
  EXPECT_NEAR(indices.total[1], y / all, 0.03);
  EXPECT_NEAR(indices.total[2], (z + xz) / all, 0.03);
}

// 128 rows are what a campaign takes: of so few the means of f(A) and f(B) are correlated by
// chance.
TEST(SobolIndices, NoFirstExceedsItsTotal) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SobolIndices indices = EstimateSobolIndices(
        [](const Eigen::MatrixXd& p) -> Eigen::VectorXd {
          return (p.col(0).array() - 0.3).square() * (1 + p.col(1).array());
        },
        {.dimension = 3, .num_base = 128, .seed = seed});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(indices.first[i], indices.total[i]) << i;
    EXPECT_EQ(indices.first[2], 0);
    EXPECT_EQ(indices.total[2], 0);
  }
}

// f = Σ k x_k, whose first indices are k² / Σ k². Of the 512 rows that an answer takes the columns
// of two halves must not be alike: with a lattice of 2 d dimensions the shares were .02 to .05 off.
TEST(SobolIndices, AreAsSureOfSixParametersAsOfTwo) {
  for (const int dimension : {2, 4, 6}) {
    const SobolIndices indices = EstimateSobolIndices(
        [&](const Eigen::MatrixXd& p) -> Eigen::VectorXd {
          return p * Eigen::VectorXd::LinSpaced(dimension, 1, dimension);
        },
        {.dimension = dimension, .num_base = 512, .seed = 3});
    double all = 0;
    for (int k = 1; k <= dimension; ++k) all += k * k;
    for (int k = 1; k <= dimension; ++k) {
      const auto i = static_cast<std::size_t>(k - 1);
      EXPECT_NEAR(indices.first[i], k * k / all, 0.01) << dimension << " parameters, " << k;
      EXPECT_NEAR(indices.total[i], k * k / all, 0.01) << dimension << " parameters, " << k;
    }
  }
}

TEST(SobolIndices, AConstantDependsOnNothing) {
  const SobolIndices indices = EstimateSobolIndices(
      [](const Eigen::MatrixXd& p) { return Eigen::VectorXd::Constant(p.rows(), 3); },
      {.dimension = 2});
  EXPECT_EQ(indices.total, (std::vector<double>{0, 0}));
}

// The default gradient of a model is by differences: against the process's own, analytic one.
TEST(ObjectiveModel, DifferencesAgreeWithTheAnalyticGradient) {
  const Eigen::MatrixXd points = RSequence(20, 3, 1);
  const Eigen::VectorXd values = (points * Eigen::Vector3d(2, 3, 4)).array().sin();
  const auto process = surrogate::GaussianProcess::Fit({points, values}, {});
  const TransformedModel model(process);
  const Eigen::Vector3d x(0.3, 0.8, 0.5);
  const MomentsGradient analytic = model.PredictWithGradient(x);
  const MomentsGradient differences = model.ObjectiveModel::PredictWithGradient(x);
  EXPECT_LT((analytic.mean_slope - differences.mean_slope).norm(), 1e-5);
  EXPECT_LT((analytic.sd_slope - differences.sd_slope).norm(), 1e-5);
}

}  // namespace answer_test
}  // namespace talus::optimizer
