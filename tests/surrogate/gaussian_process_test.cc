#include "surrogate/process/gaussian_process.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "surrogate/process/warp.h"

namespace talus::surrogate {
namespace gaussian_process_test {

Eigen::MatrixXd RandomPoints(int rows, int cols, std::uint64_t seed) {
  base::Random random(seed, base::Stream("gaussian process test"));
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return random.Uniform(); });
}

Eigen::VectorXd Waves(const Eigen::MatrixXd& points) {
  return (points * Eigen::VectorXd::LinSpaced(points.cols(), 2, 5)).array().sin() +
         points.col(0).array().square();
}

GaussianProcessState KnownState(double noise) {
  return {.hyper = {.length = Eigen::Vector3d(0.4, 0.6, 0.9),
                    .signal = 1.2,
                    .trend = 0.5,
                    .noise = Eigen::VectorXd::Constant(1, noise)},
          .centre = 3,
          .scale = 2};
}

// The formulas of the header written out with a plain inverse and one row for every evaluation,
// replicates not pooled.
Prediction DenseFormula(const Eigen::MatrixXd& points, const Eigen::VectorXd& values,
                        const GaussianProcessState& state, const Eigen::VectorXd& x) {
  const Covariance covariance(Kernel::kMatern52, state.hyper);
  const Sites columns = Sites::At(points.transpose(), 0);
  Eigen::MatrixXd k = covariance.Between(columns, columns);
  k.diagonal().array() += state.hyper.noise[0] * state.hyper.noise[0];
  const Eigen::MatrixXd inverse = k.inverse();
  const Eigen::VectorXd cross = covariance.Between(columns, Sites::At(x, 0));
  const Eigen::VectorXd scaled = (values.array() - state.centre) / state.scale;
  const double prior = covariance.At(x.data(), x.data());
  return {.mean = state.centre + state.scale * cross.dot(inverse * scaled),
          .variance = state.scale * state.scale * (prior - cross.dot(inverse * cross))};
}

struct Sample {
  Eigen::MatrixXd points;
  Eigen::VectorXd values;
};

Sample WithReplicates() {
  Sample sample{RandomPoints(16, 3, 1), {}};
  sample.points.row(9) = sample.points.row(4);
  sample.points.row(15) = sample.points.row(4);
  sample.values = Waves(sample.points);
  base::Random random(2, base::Stream("scatter"));
  for (double& value : sample.values) value += 0.1 * random.Normal();
  return sample;
}

// K has a condition number below 1e5 here; the jitter of 1e-10 beside a noise of 0.01 leaves 1e-8.
TEST(GaussianProcess, PredictionsEqualTheDenseFormulaWithReplicatesUnpooled) {
  const Sample sample = WithReplicates();
  const GaussianProcessState state = KnownState(0.1);
  const auto process = GaussianProcess::Fit({sample.points, sample.values}, {.frozen = state});
  EXPECT_EQ(process.num_points(), 14);
  const Eigen::MatrixXd places = RandomPoints(20, 3, 3);
  const Predictions all = process.PredictAll(places);
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Prediction dense = DenseFormula(sample.points, sample.values, state, places.row(i));
    EXPECT_NEAR(process.Predict(places.row(i)).mean, dense.mean, 1e-8);
    EXPECT_NEAR(process.Predict(places.row(i)).variance, dense.variance, 1e-8);
    EXPECT_NEAR(all.mean[i], dense.mean, 1e-8);
    EXPECT_NEAR(all.variance[i], dense.variance, 1e-8);
  }
}

// A mass that every simulation shows alike is not known to 1 % of itself only.
TEST(GaussianProcess, ValuesThatAreAllTheSameHaveTheScaleThatTheCallerKnows) {
  const Eigen::MatrixXd points = RandomPoints(10, 2, 3);
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(10, 0.9);
  const auto own = GaussianProcess::Fit({points, values}, {});
  const auto known = GaussianProcess::Fit({points, values}, {.usual_sd = 0.9e-3});
  const double ratio = known.Predict(points.row(0)).variance / own.Predict(points.row(0)).variance;
  EXPECT_NEAR(ratio, 1e-6, 1e-12);  // one fit in another unit
  EXPECT_NEAR(known.Predict(points.row(0)).mean, 0.9, 1e-12);
}

TEST(GaussianProcess, WarpingIsFittingAtWarpedPoints) {
  const Sample sample = WithReplicates();
  const GaussianProcessState plain = KnownState(0.1);
  GaussianProcessState warped = plain;
  warped.hyper.warp = Eigen::Vector3d(-3, 0, 2);
  const auto warp = [&](const Eigen::MatrixXd& points) -> Eigen::MatrixXd {
    return WarpAll(points.transpose(), warped.hyper.warp).transpose();
  };
  auto process =
      GaussianProcess::Fit({sample.points.topRows(12), sample.values.head(12)}, {.frozen = warped});
  for (int i = 12; i < 16; ++i) process.Add({.x = sample.points.row(i)}, sample.values[i]);
  const auto same = GaussianProcess::Fit({warp(sample.points), sample.values}, {.frozen = plain});
  const Eigen::MatrixXd places = RandomPoints(10, 3, 4);
  const Predictions here = process.PredictAll(places);
  const Predictions there = same.PredictAll(warp(places));
  EXPECT_LT((here.mean - there.mean).norm(), 1e-10);
  EXPECT_LT((here.variance - there.variance).norm(), 1e-10);
  EXPECT_NEAR(process.LogLikelihood(), same.LogLikelihood(), 1e-8);
}

// A saturating function of one coordinate, which no single correlation length fits.
TEST(GaussianProcess, InfersWhichEndOfACoordinateIsStretched) {
  const Eigen::MatrixXd points = RandomPoints(60, 2, 11);
  const Eigen::VectorXd values = points.col(0).array() / (0.1 + points.col(0).array());
  const auto process =
      GaussianProcess::Fit({points, values}, {.warp_inputs = true, .deterministic = true});
  EXPECT_LT(process.state().hyper.warp[0], -1);  // steep near 0
}

TEST(GaussianProcess, PooledLikelihoodIsTheDensityOfAllValues) {
  const Sample sample = WithReplicates();
  const GaussianProcessState state = KnownState(0.1);
  const auto process = GaussianProcess::Fit({sample.points, sample.values}, {.frozen = state});
  const Covariance covariance(Kernel::kMatern52, state.hyper);
  const Sites columns = Sites::At(sample.points.transpose(), 0);
  Eigen::MatrixXd k = covariance.Between(columns, columns);
  k.diagonal().array() += 0.01;
  k *= state.scale * state.scale;
  const Eigen::VectorXd y = sample.values.array() - state.centre;
  const double dense = -0.5 * y.dot(k.inverse() * y) - 0.5 * std::log(k.determinant()) -
                       0.5 * 16 * std::log(2 * M_PI);
  EXPECT_NEAR(process.LogLikelihood(), dense, 1e-8);
}

TEST(GaussianProcess, AddEqualsFittingAgain) {
  const Sample sample = WithReplicates();
  const GaussianProcessState state = KnownState(0.1);
  auto grown =
      GaussianProcess::Fit({sample.points.topRows(6), sample.values.head(6)}, {.frozen = state});
  for (int i = 6; i < 16; ++i) grown.Add({.x = sample.points.row(i)}, sample.values[i]);
  const auto whole = GaussianProcess::Fit({sample.points, sample.values}, {.frozen = state});
  const Eigen::MatrixXd places = RandomPoints(10, 3, 4);
  EXPECT_LT((grown.PredictAll(places).mean - whole.PredictAll(places).mean).norm(), 1e-10);
  EXPECT_LT((grown.PredictAll(places).variance - whole.PredictAll(places).variance).norm(), 1e-10);
}

TEST(GaussianProcess, LeaveOneOutEqualsFittingWithoutThePoint) {
  const Eigen::MatrixXd points = RandomPoints(15, 3, 5);
  const Eigen::VectorXd values = Waves(points);
  const GaussianProcessState state = KnownState(0.05);
  const auto process = GaussianProcess::Fit({points, values}, {.frozen = state});
  const Predictions left_out = process.LeaveOneOut();
  for (int i = 0; i < 15; ++i) {
    Eigen::MatrixXd rest(14, 3);
    rest << points.topRows(i), points.bottomRows(14 - i);
    Eigen::VectorXd rest_values(14);
    rest_values << values.head(i), values.tail(14 - i);
    const auto without = GaussianProcess::Fit({rest, rest_values}, {.frozen = state});
    const Prediction expected = without.Predict(points.row(i));
    EXPECT_NEAR(left_out.mean[i], expected.mean, 1e-9);
    EXPECT_NEAR(left_out.variance[i], expected.variance + without.noise_variance(), 1e-9);
  }
}

// Hyper-parameters drawn from their prior, a function drawn from the process they make, and a
// process that must fit its own: 100 functions × 30 places. Places of one function err together, so
// that the standard error is near 2 %, hence the wide 85 to 95 %.
TEST(GaussianProcess, NinetyPercentBandCoversDrawsFromItsPrior) {
  const int kFunctions = 100;
  const int kPlaces = 30;
  const HyperPriors priors;
  int covered = 0;
  for (int f = 0; f < kFunctions; ++f) {
    const auto seed = static_cast<std::uint64_t>(f);
    base::Random random(seed, base::Stream("prior"));
    const auto draw = [&](const LogNormal& prior) {
      return prior.median * std::exp(prior.log_sd * random.Normal());
    };
    const Eigen::Vector3d length(draw(priors.length), draw(priors.length), draw(priors.length));
    GaussianProcessState state{.hyper = {.length = length,
                                         .signal = draw(priors.signal),
                                         .noise = Eigen::VectorXd::Constant(1, 1e4)}};
    // A process with one value that is all noise has its prior as posterior.
    const Eigen::MatrixXd points = RandomPoints(40 + kPlaces, 3, 100 + seed);
    const auto prior =
        GaussianProcess::Fit({points.topRows(1), Eigen::VectorXd::Zero(1)}, {.frozen = state});
    const Eigen::VectorXd truth = prior.Draw(points, 1, random).row(0);
    const double noise = draw(priors.noise.front());
    Eigen::VectorXd values = truth.head(40);
    for (double& value : values) value += noise * random.Normal();
    const auto process = GaussianProcess::Fit({points.topRows(40), values}, {});
    const Predictions band = process.PredictAll(points.bottomRows(kPlaces));
    const Eigen::ArrayXd error = (band.mean - truth.tail(kPlaces)).array().abs();
    covered += static_cast<int>((error < 1.645 * band.variance.array().sqrt()).count());
  }
  const double coverage = covered / static_cast<double>(kFunctions * kPlaces);
  EXPECT_GT(coverage, 0.85);
  EXPECT_LT(coverage, 0.95);
}

// 4000 draws: the standard error of a mean is sd / 63, of a variance 2.2 %; four of each.
TEST(GaussianProcess, DrawsHaveThePosteriorMomentsAndCorrelation) {
  const Sample sample = WithReplicates();
  const auto process =
      GaussianProcess::Fit({sample.points, sample.values}, {.frozen = KnownState(0.3)});
  Eigen::MatrixXd places = RandomPoints(3, 3, 6);
  places.row(2) = places.row(1);  // the same place must get the same draw
  const Eigen::MatrixXd draws = process.Draw(places, 4000, base::Random(1, 2));
  for (int i = 0; i < 3; ++i) {
    const Prediction expected = process.Predict(places.row(i));
    const double mean = draws.col(i).mean();
    const double variance = (draws.col(i).array() - mean).square().mean();
    EXPECT_NEAR(mean, expected.mean, 4 * std::sqrt(expected.variance) / 63);
    EXPECT_NEAR(variance, expected.variance, 0.09 * expected.variance);
  }
  EXPECT_LT((draws.col(1) - draws.col(2)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(GaussianProcess, InfersTheNoiseOfAKnownScatter) {
  const Eigen::MatrixXd points = RandomPoints(80, 2, 7);
  Eigen::VectorXd values = Waves(points);
  base::Random random(3, base::Stream("known scatter"));
  for (double& value : values) value += 0.2 * random.Normal();
  const auto process = GaussianProcess::Fit({points, values}, {});
  // 80 values less what the function takes: a standard deviation is known to about 10 %.
  EXPECT_NEAR(std::sqrt(process.noise_variance()), 0.2, 0.05);
}

TEST(GaussianProcess, StaysFiniteForDuplicatesNeighboursAndConstantValues) {
  Eigen::MatrixXd points = RandomPoints(12, 3, 8);
  for (int i = 6; i < 12; ++i) points.row(i) = points.row(i - 6);  // duplicates
  for (int i = 9; i < 12; ++i) points.row(i).array() += 1e-13;     // and near-duplicates
  const Eigen::VectorXd place = RandomPoints(3, 1, 9);
  for (const bool deterministic : {false, true}) {
    for (const double value : {0.0, 5.0, -1e9}) {
      const auto process =
          GaussianProcess::Fit({points, Eigen::VectorXd::Constant(12, value)},
                               {.trend = Trend::kQuadratic, .deterministic = deterministic});
      const PredictionGradient at = process.PredictWithGradient(place);
      EXPECT_NEAR(at.value.mean, value, 1e-6 * std::abs(value) + 1e-12);
      EXPECT_TRUE(at.mean.allFinite() && at.variance.allFinite());
      if (!deterministic) {  // zeros make it no more certain than fives
        EXPECT_GT(at.value.variance, 1e-12);
      }
    }
    const auto process =
        GaussianProcess::Fit({points, Waves(points)}, {.deterministic = deterministic});
    EXPECT_TRUE(std::isfinite(process.Predict(place).variance));
    EXPECT_TRUE(process.LeaveOneOut().mean.allFinite());
  }
}

TEST(GaussianProcess, RefusesWhatItCannotFit) {
  EXPECT_THROW(GaussianProcess::Fit({Eigen::MatrixXd(0, 3), Eigen::VectorXd(0)}, {}), base::Error);
  EXPECT_THROW(GaussianProcess::Fit({RandomPoints(3, 3, 1), Eigen::VectorXd::Constant(3, NAN)}, {}),
               base::Error);
}

}  // namespace gaussian_process_test
}  // namespace talus::surrogate
