#include "optimizer/search/knowledge_gradient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/search/scalar_model.h"

namespace talus::optimizer {
namespace knowledge_gradient_test {

// The trapezium rule over ±9 standard deviations is off by its kinks alone, < 1e-7 at this step.
double ByQuadrature(const Eigen::VectorXd& mean, const Eigen::VectorXd& slope) {
  constexpr double kStep = 1e-3;
  double sum = 0;
  for (double z = -9; z <= 9; z += kStep) {
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
    sum += kStep * density * (mean + z * slope).minCoeff();
  }
  return mean.minCoeff() - sum;
}

TEST(KnowledgeGradient, ClosedFormIsTheIntegral) {
  base::Random random(3, base::Stream("lines"));
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::VectorXd mean(6);
    Eigen::VectorXd slope(6);
    for (double& m : mean) m = random.Normal();
    for (double& s : slope) s = random.Normal();
    if (trial % 5 == 0) slope[3] = slope[1];  // parallel lines
    EXPECT_NEAR(ExpectedDropOfMinimum(mean, slope), ByQuadrature(mean, slope), 1e-6) << trial;
  }
}

// The minimum that moves with the evaluation, but whose place stays, is no gain.
TEST(KnowledgeGradient, IsZeroWhereNoDecisionCanChange) {
  EXPECT_EQ(ExpectedDropOfMinimum(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d::Constant(0.7)), 0);
  EXPECT_EQ(ExpectedDropOfMinimum(Eigen::VectorXd::Constant(1, 2), Eigen::VectorXd::Ones(1)), 0);
}

class NoisyBowl : public ::testing::Test {
 protected:
  static Eigen::VectorXd Values(const Eigen::MatrixXd& points) {
    base::Random random(1, base::Stream("noisy bowl"));
    Eigen::VectorXd values = (points.array() - 0.4).square().rowwise().sum();
    for (double& value : values) value += 0.05 * random.Normal();
    return values;
  }

  const Eigen::MatrixXd points_ = RSequence(30, 2, 1);
  const TransformedModel model_{surrogate::GaussianProcess::Fit(
      {points_, Values(points_)}, {.trend = surrogate::Trend::kQuadratic})};
  const Domain domain_{.num_parameters = 2};
  const Feasibility feasibility_{};
  const ModelView view_{.model = model_,
                        .feasibility = feasibility_,
                        .domain = domain_,
                        .points = points_,
                        .failure_cost = 1,
                        .searches = {},
                        .seed = 5};
};

// The gain found is that of evaluating there: simulated by adding many possible values, the lowest
// mean drops by it on average.
TEST_F(NoisyBowl, GainIsTheMeanDropOfTheLowestPosteriorMean) {
  const Eigen::MatrixXd minimisers = PossibleMinimisers(view_);
  ASSERT_GT(minimisers.rows(), 5);
  const KnowledgeStep step =
      MostKnowledge(view_, GainsOfValues(model_.process(), minimisers), minimisers);
  const double before = model_.Means(minimisers).minCoeff();
  const surrogate::Prediction at = model_.process().Predict(step.point);
  const double sd = std::sqrt(at.variance + model_.process().noise_variance());
  double sum = 0;
  constexpr int kNumValues = 400;  // at the middles of as many equally probable slices
  for (int i = 0; i < kNumValues; ++i) {
    const double z = std::numbers::sqrt2 * [](double p) {  // inverse of erf by Newton's method
      double x = 0;
      for (int k = 0; k < 60; ++k) {
        x -= (std::erf(x) - p) * std::sqrt(std::numbers::pi) / 2 * std::exp(x * x) * 0.7;
      }
      return x;
    }(2 * (i + 0.5) / kNumValues - 1);
    surrogate::GaussianProcess told = model_.process();
    told.Add({.x = step.point}, at.mean + sd * z);
    sum += before - told.PredictAll(minimisers).mean.minCoeff();
  }
  // 400 slices leave the tails out: a few per cent.
  EXPECT_NEAR(sum / kNumValues, step.gain, 0.05 * step.gain);
}

TEST_F(NoisyBowl, NoOtherPointTeachesMore) {
  const Eigen::MatrixXd minimisers = PossibleMinimisers(view_);
  const KnowledgeStep step =
      MostKnowledge(view_, GainsOfValues(model_.process(), minimisers), minimisers);
  const surrogate::AnchorPoints anchors = model_.process().Anchor(minimisers);
  const Eigen::VectorXd mean = model_.Means(minimisers);
  const auto at = model_.process().PosteriorCovariances(anchors, RSequence(500, 2, 9));
  for (Eigen::Index i = 0; i < at.variance.size(); ++i) {
    const double sd = std::sqrt(at.variance[i] + model_.process().noise_variance());
    EXPECT_LE(ExpectedDropOfMinimum(mean, at.between.col(i) / sd), 1.001 * step.gain);
  }
}

}  // namespace knowledge_gradient_test
}  // namespace talus::optimizer
