#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "experiments/analysis/next/judge_test.h"
#include "experiments/analysis/next/known.h"
#include "experiments/analysis/next/test_design.h"
#include "experiments/campaign/make_parts.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {
namespace surrogate_share_test {

namespace fs = std::filesystem;

class SurrogateShareTest : public campaign::CampaignFixture {};

TEST(Known, SurrogateShareIsTheMeanOverTheOutputsOfAllExperiments) {
  Known image{.experiment = 0, .at = {}, .surrogate = Eigen::Vector2d(1, 3)};
  image.at.measured = Eigen::Vector2d(1, 0.5);
  image.at.model = Eigen::Vector2d(0, 0.5);
  Known number{.experiment = 1, .at = {}, .surrogate = Eigen::VectorXd::Constant(1, 1)};
  number.at.measured = Eigen::VectorXd::Constant(1, 2);
  number.at.model = Eigen::VectorXd::Constant(1, 1);
  EXPECT_NEAR(SurrogateShare({image, number}), (0.5 + 0.75 + 0.25) / 3, 1e-15);
}

// Of a measured, a model's and a surrogate's variance of 1 each one is taken away. From 3 to 2 they
// fall by a measurement of variance 1/(1/2 - 1/3), and of twice that where misfits count half.
TEST(Known, LessVarianceIsWhatAMeasurementByItselfWouldLeave) {
  constexpr int kSets = 200;
  const campaign::JointView view{};
  const Ground ground{.view = view, .draws = Eigen::VectorXd::LinSpaced(kSets, 0, 1)};
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  Known known{.at = {}, .surrogate = one, .weight = 0.5};
  known.at.mean = 20 * ground.draws;
  known.at.measured = known.at.model = one;
  const double spread = 400 * kSets * (kSets + 1.0) / (12 * (kSets - 1.0) * (kSets - 1.0));
  const auto bits = [&](double variance) { return 0.5 * std::log2(1 + spread / variance); };
  EXPECT_NEAR(LearnWhenLess(ground, known, one).bits, bits(12), 1e-9);
  EXPECT_NEAR(LearnWithoutSurrogate(ground, {known}).bits, bits(12), 1e-9);
  known.weight = 1;
  EXPECT_NEAR(LearnWhenLess(ground, known, one).bits, bits(6), 1e-9);
}

// With half of its variance the surrogate's, a test's errors are √2 times as large.
TEST_F(SurrogateShareTest, AFurtherTestTeachesLessWhereSurrogatesKnowLess) {
  const fs::path folder = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]},
    "budget": {"simulations": 24}, "confirm": {"candidates": 0}, "workers": 1)");
  campaign::RunFake(folder, {});
  const campaign::JointView view = campaign::ReadJointView(folder);
  const TestCandidate test{.name = "the heap again"};
  const Eigen::MatrixXd draws = campaign::AnsweringStrategy(view)->Sample().Draws(200, 1);
  const campaign::CampaignParts parts{
      .runner = campaign::MakeDrawnRunner(view.spec, view.folder.root),
      .engine = std::make_unique<campaign::FakeEngine>(campaign::FakeEngineOptions{})};
  const TestDesign design = SimulateDesign(view, test, {.draws = draws}, parts);
  const auto judged = [&](double share) {
    NextCandidate candidate{.kind = NextKind::kTest, .name = test.name};
    JudgeTest({.view = view, .draws = draws, .surrogate_share = share},
              {.test = test, .design = design, .unknown = {}}, candidate);
    return candidate;
  };
  const NextCandidate known = judged(0);
  const NextCandidate guessed = judged(0.5);
  EXPECT_NEAR((guessed.predicted.variance - 2 * known.predicted.variance).norm(), 0, 1e-12);
  EXPECT_LT(guessed.learning->bits, known.learning->bits);
}

}  // namespace surrogate_share_test
}  // namespace talus::analysis
