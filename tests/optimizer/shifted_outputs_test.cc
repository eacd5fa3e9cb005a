#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"
#include "optimizer/posterior/measured_response.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::optimizer {
namespace shifted_outputs_test {

// One number, y = 10 + 5 x with a scatter of 0.05, measured as 12.5: x = 0.5. So x moves by 1/5 of
// what y moves.
class ShiftedOutputs : public ::testing::Test {
 protected:
  static constexpr double kSlope = 5;
  static constexpr double kMeasured = 12.5;

  ShiftedOutputs()
      : target_{.name = "y", .value = kMeasured, .standard_error = 0.05},
        strategy_({.scale_factors = {1}, .target = 1}, Domain{.num_parameters = 1},
                  {ExperimentTarget{.name = "test", .scalars = {target_}}}) {
    base::Random random(1, base::Stream("shifted outputs"));
    for (int i = 0; i < 24; ++i) {
      const double x = (i + 0.5) / 24;
      const double y = 10 + kSlope * x + 0.05 * random.Normal();
      strategy_.Tell({.point = Eigen::VectorXd::Constant(1, x), .scalars = {y}});
    }
  }
  // What a simulation adds that shows so much more than what was measured.
  double More(double y) const {
    return Compress(target_, kMeasured + y) - Compress(target_, kMeasured);
  }
  // Had the simulations shown so much more.
  AnswerIfShifted With(const std::function<double(double x)>& more) {
    const auto shift = [&](const Eigen::MatrixXd& points) -> Eigen::MatrixXd {
      return points.unaryExpr([&](double x) { return More(more(x)); });
    };
    return strategy_.IfShifted({shift});
  }

  ScalarTarget target_;
  PosteriorStrategy strategy_;
};

// Simulations that show 1 more fit where they showed 1 less.
TEST_F(ShiftedOutputs, PointFollowsWhatSimulationsShow) {
  ASSERT_TRUE(strategy_.CanModel());
  const double now = With([](double) { return 0.0; }).point[0];
  EXPECT_EQ(now, strategy_.Recommend().point[0]);
  // The model's error and the draws leave 0.02.
  EXPECT_NEAR(With([](double) { return 1.0; }).point[0], now - 1 / kSlope, 0.02);
  EXPECT_NEAR(With([](double) { return -1.0; }).point[0], now + 1 / kSlope, 0.02);
}

// 10 + 5 x + 2 x = 12.5 at x = 0.357.
TEST_F(ShiftedOutputs, AShiftMayDependOnTheSet) {
  EXPECT_NEAR(With([](double x) { return 2 * x; }).point[0], 2.5 / 7, 0.02);  // as above
}

// 10 + 5 x - 6 is 9 at most, which misses 12.5 by seventy of its errors; what the surrogate does
// not know excuses some of it.
TEST_F(ShiftedOutputs, WhereNoSetFitsItIsSaid) {
  EXPECT_LT(With([](double) { return 1.0; }).implausibility, 1);
  const AnswerIfShifted answer = With([](double) { return -6.0; });
  EXPECT_GT(answer.point[0], 0.95);
  EXPECT_GT(answer.implausibility, 3);
}

TEST_F(ShiftedOutputs, RangesFollowIt) {
  const std::vector<Range> now = strategy_.Recommend().credible;
  const std::vector<Range> same = With([](double) { return 0.0; }).credible;
  ASSERT_EQ(same.size(), 1u);
  EXPECT_EQ(same[0].low, now[0].low);
  EXPECT_EQ(same[0].high, now[0].high);
  const Range moved = With([](double) { return 1.0; }).credible[0];
  EXPECT_NEAR(moved.low, now[0].low - 1 / kSlope, 0.02);  // as above
  EXPECT_NEAR(moved.high, now[0].high - 1 / kSlope, 0.02);
}

TEST_F(ShiftedOutputs, ResponseIsTheInverseSlope) {
  const Eigen::MatrixXd response =
      ResponseToMeasured(strategy_.Model(), strategy_.Sample().Draws(1000, 1));
  ASSERT_EQ(response.size(), 1);
  // d output/dx = slope × d Compress/dy; 1000 draws tell the covariance within a tenth.
  const double output_per_x = kSlope * More(1e-3) / 1e-3;
  EXPECT_NEAR(response(0, 0) * output_per_x, 1, 0.15);
}

// Its outputs are what the model is told of it.
TEST_F(ShiftedOutputs, OutputsOfASimulationAreTheCompressedNumbers) {
  const ExperimentModel& model = strategy_.Model().models().front();
  EXPECT_DOUBLE_EQ(model.OutputsOf({}, {13.0})[0], Compress(target_, 13.0));
  // Some twenty values tell a standard deviation to 15 %.
  EXPECT_NEAR(std::sqrt(model.NoiseAt(1)[0]) / More(0.05), 1, 0.3);
}

}  // namespace shifted_outputs_test
}  // namespace talus::optimizer
