#include "optimizer/outputs/output_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/surrogate/curves.h"

namespace talus::optimizer {
namespace output_model_test {

using test::Curve;
using test::kElements;

constexpr int kPoints = 25;

// Those whose own value came near the target by their noise were chosen: the slope of y = x became
// a half.
TEST(RowsToModel, AreNotChosenByTheirNoise) {
  base::Random random(3, base::Stream("rows to model"));
  OutputData data;
  std::vector<double> misses;
  for (int i = 0; i < 1200; ++i) {
    const double x = i < 100 ? random.Uniform() : 0.5 + 0.1 * random.Normal();
    const double y = x + 0.1 * random.Normal();
    data.points.push_back(Eigen::VectorXd::Constant(1, x));
    data.level.push_back(0);
    data.scalars.push_back({y});
    misses.push_back(std::abs(y - 0.5));
  }
  double n = 0, x1 = 0, y1 = 0, xx = 0, xy = 0;
  for (const std::size_t row : RowsToModel(data, misses, 1200)) {
    const double x = data.points[row][0];
    if (std::abs(x - 0.5) > 0.2) continue;
    const double y = data.scalars[row][0];
    n += 1, x1 += x, y1 += y, xx += x * x, xy += x * y;
  }
  ASSERT_GT(n, 250);
  // 0.1 of noise over 300 values with a spread of 0.09 leave the slope 0.065: two and a half of it.
  EXPECT_NEAR((n * xy - x1 * y1) / (n * xx - x1 * x1), 1, 0.16);
}

// The first `count` of kPoints evaluations.
OutputData MakeData(double noise, int count = kPoints) {
  base::Random random(5, base::Stream("output model test"));
  OutputData data;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector2d x(random.Uniform(), random.Uniform());
    Eigen::VectorXd vector = Curve(x);
    for (double& element : vector) element += noise * random.Normal();
    if (i >= count) continue;
    data.points.push_back(x);
    data.level.push_back(0);
    data.vectors.push_back(vector);
    data.scalars.emplace_back();
  }
  return data;
}

TEST(OutputModel, PredictsCurvesItHasNotSeen) {
  const OutputModel model({.deterministic = true}, MakeData(0), nullptr);
  const Eigen::Vector2d x(0.4, 0.6);
  const Eigen::VectorXd predicted =
      model.modes().mean +
      model.modes().basis * model.PredictModes(x.transpose()).mean.row(0).transpose();
  // The curves differ by about 1; 25 points in two dimensions leave a few thousandths.
  EXPECT_LT((predicted - Curve(x)).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_EQ(model.ElementNoise(), Eigen::VectorXd::Zero(kElements));
}

TEST(OutputModel, NoiseOfElementsIsThatOfTheData) {
  const OutputModel model({}, MakeData(0.1), nullptr);
  // 25 points tell a variance to within √(2/25) ≈ 30 % a mode. Noise that is the same along every
  // mode is not what heaps have (output_noise.h): the prior takes it for more along the strongest.
  EXPECT_NEAR(std::sqrt(model.ElementNoise().mean()) / 0.1, 1, 0.3);
}

// Heaps have N ∝ f⁻³ grains, and their mean a variance of 1/N: what the finest ones at 1.5 scatter
// by is a (1/1.5)³ smaller variance at 1.
TEST(OutputModel, NoiseAtAFinerTargetIsThatOfMoreGrains) {
  OutputData data = MakeData(0.1);
  for (int i = 0; i < kPoints; ++i) data.level[static_cast<std::size_t>(i)] = i % 3;
  const OutputModel model({.levels = Levels({3, 2, 1.5}, 1)}, data, nullptr);
  ASSERT_GT(model.num_modes(), 0);
  for (Eigen::Index k = 0; k < model.num_outputs(); ++k) {
    EXPECT_NEAR(model.TargetNoise(k) / model.output(k).noise_variance(2), 8.0 / 27, 1e-12);
  }
}

TEST(OutputModel, LeaveOneOutIsFittingWithoutTheEvaluation) {
  const OutputData all = MakeData(0.05);
  const OutputModel model({}, all, nullptr);
  const OutputState frozen = model.state();
  const ModeMoments left_out = model.LeaveModesOut();
  const OutputModel fewer({}, MakeData(0.05, kPoints - 1), &frozen);
  const ModeMoments refitted = fewer.PredictModes(all.points.back().transpose());
  const Eigen::RowVectorXd mean = left_out.mean.row(kPoints - 1);
  const Eigen::RowVectorXd variance = left_out.variance.row(kPoints - 1);
  // One is a formula, the other an elimination: rounding times the condition of the matrices.
  EXPECT_LT((mean - refitted.mean).norm(), 1e-8);
  EXPECT_LT((variance - refitted.variance - fewer.ModeNoise().transpose()).norm(), 1e-8);
}

TEST(OutputModel, LeavesReplicatesOutTogether) {
  OutputData data = MakeData(0.05);
  data.points[4] = data.points[1];
  const OutputModel model({}, data, nullptr);
  const Eigen::MatrixXd z = model.LeaveOneOut();
  EXPECT_TRUE(z.row(1).allFinite());
  EXPECT_TRUE(z.row(4).array().isNaN().all());
}

TEST(OutputModel, AFantasyLeavesTheMeanAndTakesVariance) {
  OutputModel model({}, MakeData(0.05), nullptr);
  const Eigen::RowVector2d x(0.3, 0.8);
  const ModeMoments before = model.PredictModes(x);
  model.AddFantasy(x.transpose());
  const ModeMoments after = model.PredictModes(x);
  EXPECT_LT((after.mean - before.mean).norm(), 1e-8);
  EXPECT_TRUE((after.variance.array() < before.variance.array()).all());
}

// What was measured at or near 0 is as many errors from what a set gives as it is, within the 3 %
// by which asinh bends at 0.4 of its scale: a test that arched excludes sets that flow as one that
// flowed excludes those that arch.
TEST(OutputModel, ErrorsFromANumberNearZeroCountAsTheyAre) {
  const auto errors_to = [](double measured, double value) {
    const ScalarTarget target{.name = "flows", .value = measured, .standard_error = 0.25};
    return (Compress(target, value) - Compress(target, measured)) / CompressedError(target);
  };
  EXPECT_NEAR(errors_to(0, 1), 4, 0.12);
  EXPECT_NEAR(errors_to(1, 0), -4, 0.32);  // errors at 1 are 7 % shorter than at 0
  EXPECT_NEAR(errors_to(0.25, 1.25), 4, 0.2);
}

// Far above its error a number bends from its own size on, whatever the error.
TEST(OutputModel, ValuesFarAboveTheTargetAreCompressed) {
  const ScalarTarget target{.name = "mass", .value = 5, .standard_error = 0.1};
  EXPECT_DOUBLE_EQ(CompressionScale(target), 5.1);
  EXPECT_LT(Compress(target, 5000) - Compress(target, 500), std::log(10.0) + 0.01);
}

// A number that some evaluations do not have is modelled by the others.
TEST(OutputModel, SkipsUndefinedNumbers) {
  OutputData data = MakeData(0.05);
  for (int i = 0; i < kPoints; ++i) {
    const auto k = static_cast<std::size_t>(i);
    data.scalars[k] = {i % 5 == 0 ? NAN : 3 + data.points[k][0]};
  }
  const ScalarTarget target{.name = "mass", .value = 3.5, .standard_error = 0.1};
  const OutputModel model({.scalars = {target}}, data, nullptr);
  const Eigen::RowVector2d x(0.5, 0.5);
  const Eigen::Index number = model.num_modes();
  EXPECT_NEAR(model.output(number).PredictAll(x).mean[0], Compress(target, 3.5), 0.02);
  EXPECT_TRUE(std::isnan(model.LeaveOneOut()(5, number)));
}

}  // namespace output_model_test
}  // namespace talus::optimizer
