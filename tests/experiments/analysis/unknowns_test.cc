// What `talus next` makes of things that are held fixed and that nobody has measured.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/random.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/analysis/next/rank_next.h"
#include "experiments/analysis/next/unknown_moves.h"
#include "experiments/analysis/next/unknown_shift.h"
#include "experiments/analysis/next/usual_tests.h"
#include "experiments/analysis/sensitivity/sensitivity.h"
#include "experiments/analysis/sensitivity/sensitivity_text.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {
namespace unknowns_test {

using campaign::FakeEngine;
using campaign::JointView;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

// The slope of a drawn heap follows μ_r + 0.2 (0.9 - e); a tapped density knows no restitution.
class UnknownsTest : public campaign::CampaignFixture {
 protected:
  static constexpr campaign::FakeEngineOptions kBouncing{
      .restitution_as_rolling = 0.2, .mass_scatter = 1e-7, .density_scatter = 0.5};

  JointView Run() {
    folder_ = Finished(R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 24}, "confirm": {"candidates": 0}, "workers": 1)",
                       kBouncing);
    return campaign::ReadJointView(folder_);
  }
  static campaign::CampaignParts Parts(const JointView& view) {
    return {.runner = campaign::MakeDrawnRunner(view.spec, view.folder.root),
            .engine = std::make_unique<FakeEngine>(kBouncing)};
  }
  static NextTable Rank(const JointView& view, bool simulate) {
    std::vector<TestCandidate> tests = UsualTests(view);
    std::erase_if(tests, [](const TestCandidate& test) { return test.name != "tapped density"; });
    tests.front().numbers.Of<rigs::Observable::kTappedDensity>() = {.standard_error = 1};
    tests.push_back({.name = "again"});
    NextOptions options{.tests = std::move(tests), .simulate = simulate};
    options.parts = Parts(view);
    return RankNext(view, options);
  }
  static void Move(const JointView& view, std::vector<std::pair<std::string, std::string>> moves) {
    SensitivityOptions options{.moves = std::move(moves)};
    options.parts = Parts(view);
    WriteSensitivity(FindSensitivity(view, options), view.folder.root);
  }
  static const NextCandidate& Find(const NextTable& table, const std::string& name) {
    for (const NextCandidate& c : table.candidates) {
      if (c.name == name) return c;
    }
    throw base::Error("no candidate " + name);
  }
  fs::path folder_;
};

TEST_F(UnknownsTest, ATestThatDependsOnTheRestitutionLosesBitsAndAnotherKeepsThem) {
  const JointView view = Run();
  const NextTable before = Rank(view, true);
  Move(view, {{"restitution", "0.6"}});
  const NextTable after = Rank(view, true);
  const NextCandidate& heap = Find(after, "again");
  EXPECT_EQ(*heap.bits_if_known, Find(before, "again").learning->bits);
  EXPECT_LT(heap.learning->bits, *heap.bits_if_known - 1);
  // 0.06 of slope, where one coarse heap scatters by 0.01 and three true ones with a model error as
  // large by 0.01 √(4/3 / 8): 15 errors of a slope, and more where an image has modes that scatter
  // less. Four and eight heaps leave it to 0.006, two errors, and the surrogate has its share.
  ASSERT_EQ(heap.unknowns.size(), 1u);
  EXPECT_GT(heap.unknowns[0].shift, 11);
  // The slope tells μ_r: of that range more is left.
  EXPECT_GT(heap.learning->width[1], Find(before, "again").learning->width[1]);
  EXPECT_THAT(NextText(after), HasSubstr("bits if what it depends on were known: restitution (0.6 "
                                         "in place of 0.9 shifts it by"));
  EXPECT_THAT(NextJson(after), HasSubstr("\"depends_on\""));
  EXPECT_THAT(NextSummary(after), HasSubstr("again, which depends on restitution: expected"));
  const NextCandidate& taps = Find(after, "tapped density");
  EXPECT_EQ(taps.learning->bits, Find(before, "tapped density").learning->bits);
  EXPECT_TRUE(taps.unknowns.empty());
  EXPECT_THAT(taps.what, Not(HasSubstr("depends")));
  EXPECT_EQ(Find(Rank(view, false), "again").learning->bits, heap.learning->bits)
      << "the simulations are kept";
}

TEST_F(UnknownsTest, WhatHasNotBeenSimulatedIsSaidAndNotDiscounted) {
  const JointView view = Run();
  const NextTable before = Rank(view, true);
  Move(view, {{"restitution", "0.6"}});
  const NextCandidate heap = Find(Rank(view, false), "again");
  EXPECT_EQ(heap.learning->bits, Find(before, "again").learning->bits);
  EXPECT_THAT(heap.what, HasSubstr("what it owes to restitution is judged by 12 simulations"));
}

// The usual move of a pair is a share of what acts: of a rough plate that is another number.
TEST_F(UnknownsTest, AUsualMoveIsTheTestsOwnAndAGivenValueIsThatValue) {
  const JointView view = Run();
  const std::vector<TestCandidate> usual = UsualTests(view);
  const auto rough = std::ranges::find(usual, "rough plate", &TestCandidate::name);
  ASSERT_NE(rough, usual.end());
  const TestDesign design{.scale_factor = 2, .middle = Eigen::Vector2d(0.5, 0.5)};
  const auto pair_of = [&] {
    const std::vector<analysis::Move> moves = UnknownMoves(view, *rough, design);
    return *std::ranges::find(moves, "plate_pair_sliding_friction", &analysis::Move::name);
  };
  EXPECT_TRUE(UnknownMoves(view, *rough, design).empty()) << "nothing has been moved";
  Move(view, {});
  EXPECT_NEAR(std::stod(pair_of().to) / std::stod(pair_of().from), 0.8, 1e-3);
  Move(view, {{"plate_pair_sliding_friction", "0.25"}});
  EXPECT_EQ(pair_of().to, "0.25");
}

Eigen::MatrixXd Noise(base::Random& random, Eigen::Index num_rows, Eigen::Index num_columns) {
  Eigen::MatrixXd rows(num_rows, num_columns);
  for (double& value : rows.reshaped()) value = random.Normal();
  return rows;
}

// Six modes of an image and two numbers, judged as three: 0.3 % of the draws are expected.
TEST(UnknownShift, ChanceAloneShiftsNothing) {
  base::Random random(5, base::Stream("unknown shift"));
  const Eigen::VectorXd noise = Eigen::VectorXd::Ones(8);
  int num_shifted = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::MatrixXd moved = Noise(random, 4, 8);
    const Eigen::MatrixXd base = Noise(random, 8, 8);
    const auto shift =
        ShiftBeyondChance({.moved = moved, .base = base, .noise = noise, .num_modes = 6});
    num_shifted += shift.isZero(0) ? 0 : 1;
  }
  EXPECT_LT(num_shifted, 18);  // 6 on average; more with p < 1e-4
}

TEST(UnknownShift, OfOneNumberIsFoundAndLeavesTheOthersAlone) {
  base::Random random(6, base::Stream("unknown shift"));
  Eigen::MatrixXd moved = Noise(random, 4, 3);
  Eigen::MatrixXd base = Noise(random, 8, 3);
  moved.col(1).array() += 20;
  moved(0, 1) = std::numeric_limits<double>::quiet_NaN();
  moved.col(2).setConstant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::VectorXd noise = Eigen::VectorXd::Ones(3);
  const auto shift =
      ShiftBeyondChance({.moved = moved, .base = base, .noise = noise, .num_modes = 1});
  EXPECT_EQ(shift[0], 0);
  EXPECT_NEAR(shift[1], 20, 3 * std::sqrt(1.0 / 3 + 1.0 / 8));
  EXPECT_EQ(shift[2], 0);
}

TEST(UnknownShift, ScatterIsPooledOverSetsOfDifferentMeans) {
  Eigen::MatrixXd first(3, 1), second(2, 1);
  first << 1, 2, 3;
  second << 10, 14;
  // (1 + 0 + 1 + 4 + 4) over 2 + 1 degrees of freedom.
  EXPECT_NEAR(PooledVariance({first, second})[0], 10.0 / 3, 1e-12);
}

// Two outputs, the second of which the shift moves along with the first: their bits are those of
// the 2 × 2 determinants.
TEST(UnknownShift, BitsAreThoseOfTheErrorsAndTheShiftTogether) {
  base::Random random(7, base::Stream("unknown shift"));
  const Eigen::MatrixXd draws = Noise(random, 400, 2);
  const optimizer::PredictedMeasurement predicted{.mean = 3 * draws,
                                                  .variance = Eigen::Vector2d(1, 4)};
  const Eigen::Vector2d shift(2, -1);
  const Eigen::MatrixXd centred = predicted.mean.rowwise() - predicted.mean.colwise().mean();
  const Eigen::Matrix2d covariance = centred.transpose() * centred / 399;
  Eigen::Matrix2d errors = predicted.variance.asDiagonal();
  errors += shift * shift.transpose();
  const double bits = 0.5 * std::log2((errors + covariance).determinant() / errors.determinant());
  const auto less = WithShifts(predicted, {shift});
  EXPECT_NEAR(optimizer::Learn(draws, less, 1).bits, bits, 1e-9);
  EXPECT_GT(optimizer::Learn(draws, predicted, 1).bits, bits + 0.5);
}

}  // namespace unknowns_test
}  // namespace talus::analysis
