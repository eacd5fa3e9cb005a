#include "optimizer/posterior/experiment_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>

#include "tests/optimizer/heap_image.h"

namespace talus::optimizer {
namespace experiment_model_test {

constexpr double kRough = 0.25;  // [px], of the strongest wave on a heap's surface

// A heap whose surface moves in waves, longer ones more: as heaps of many grains do.
std::vector<float> RoughHeap(const Eigen::VectorXd& u, std::uint64_t seed) {
  base::Random random(seed, base::Stream("rough heap"));
  surrogate::ColumnEdges edges = SmoothHeap(u);
  for (int wave = 1; wave <= 20; ++wave) {
    const double height = kRough / std::sqrt(wave) * random.Normal();
    const double place = kHeapSize.width * random.Uniform();
    for (int c = 0; c < kHeapSize.width; ++c) {
      const double phase = std::numbers::pi * wave * (c - place) / kHeapSize.width;
      edges.height[c] += height * std::sin(phase);
    }
  }
  return surrogate::Render(edges, kHeapSize, surrogate::Vessel(kHeapSize));
}

ExperimentTarget RoughTarget() {
  return {.name = "heap",
          .image = {.width = kHeapSize.width,
                    .height = kHeapSize.height,
                    .target = RoughHeap(Eigen::Vector2d(0.5, 0.5), 1),
                    .sad_scale = 1}};
}

// 24 rough heaps, other ones for each `search`.
OutputData RoughData(const surrogate::FieldCode& code, std::uint64_t search) {
  base::Random random(search, base::Stream("points"));
  OutputData data;
  for (int i = 0; i < 24; ++i) {
    const Eigen::Vector2d x(random.Uniform(), random.Uniform());
    data.points.push_back(x);
    data.level.push_back(0);
    data.vectors.push_back(
        code.Encode(RoughHeap(x, 1000 * search + static_cast<std::uint64_t>(i))));
    data.scalars.emplace_back();
  }
  return data;
}

// Noise that is taken for too small makes a region too small; the strongest mode, which moves most
// with the parameters, is where a process finds that hardest to see.
TEST(ExperimentModel, KnowsTheNoiseOfEveryMode) {
  const Levels levels({1}, 0);
  const Eigen::Vector2d middle(0.5, 0.5);
  const ExperimentTarget target = RoughTarget();
  const auto code = std::make_shared<surrogate::EdgeCode>(kHeapSize, target.image.target);
  constexpr int kSearches = 6;
  Eigen::VectorXd log_ratio = Eigen::VectorXd::Zero(8);
  for (std::uint64_t search = 1; search <= kSearches; ++search) {
    const ExperimentModel model({.target = &target, .code = code, .levels = &levels},
                                RoughData(*code, search), nullptr);
    const surrogate::PrincipalModes modes = model.state().modes;
    constexpr int kFresh = 100;
    Eigen::MatrixXd fresh(kFresh, model.num_outputs());
    for (int i = 0; i < kFresh; ++i) {
      fresh.row(i) = modes.Coefficients(
          code->Encode(RoughHeap(middle, 500'000 + static_cast<std::uint64_t>(i))));
    }
    const Eigen::RowVectorXd mean = fresh.colwise().mean();
    const Eigen::VectorXd variance =
        (fresh.rowwise() - mean).colwise().squaredNorm().transpose() / (kFresh - 1);
    const Eigen::VectorXd single = model.Predict(middle.transpose()).single;
    log_ratio += 0.5 * (single.array() / variance.array()).log().matrix() / kSearches;
  }
  // 24 heaps leave a single search within a factor of 1.5; a prior that is off by a factor of two
  // moves the mean over searches of some mode by 0.5 or more.
  for (const double mode : log_ratio) EXPECT_NEAR(mode, 0, 0.35);
}

// A prior worth 8 squared deviations stands beside those of 3 runs along 8 modes: equal runs have
// none of the 16 that are expected, and scatter by (0 + 8)/(16 + 8) of what simulations do. Those
// of 5 would by 8/40, of which a quarter is believed.
TEST(ExperimentModel, EqualRunsScatterLessThanSimulationsAndNotByNothing) {
  const Levels levels({1}, 0);
  ExperimentTarget target = RoughTarget();
  const auto code = std::make_shared<surrogate::EdgeCode>(kHeapSize, target.image.target);
  const OutputData data = RoughData(*code, 1);
  const auto check = [&](std::size_t num_runs, double share) {
    target.runs.assign(num_runs, target.image.target);
    const ExperimentModel model({.target = &target, .code = code, .levels = &levels}, data,
                                nullptr);
    ASSERT_EQ(model.num_outputs(), 8);
    const OutputPredictions at = model.Predict(Eigen::RowVector2d(0.5, 0.5));
    for (Eigen::Index k = 0; k < 8; ++k) {
      EXPECT_NEAR(at.model[k] / at.single[k], share, 1e-9);
      EXPECT_NEAR(at.measured[k] / at.single[k], share / static_cast<double>(num_runs), 1e-9);
    }
  };
  check(3, 1.0 / 3);
  check(5, 0.25);
}

// An angle by a line of one parameter, where so many of 24 sets were evaluated at the finest scale
// factor, and the first of them twice.
OutputData Angles(int num_finest) {
  OutputData data;
  for (int i = 0; i < 25; ++i) {
    const double u = (i % 24 + 0.5) / 24;
    data.points.push_back(Eigen::VectorXd::Constant(1, u));
    data.level.push_back(i % 24 < num_finest ? 1 : 0);
    data.scalars.push_back({20 + 8 * u + 0.1 * std::sin(40.0 * i)});
  }
  return data;
}

// 1.2 √(1 + 15/n) of n sets, of which six at most count where the target is finer still.
TEST(ExperimentModel, CautionEndsWithTheSetsAtTheFinestUnlessTheTargetIsBeyond) {
  const ExperimentTarget target{.name = "box", .scalars = {{"angle_deg", 25, 0.5}}};
  const auto caution = [&](const Levels& levels, int num_finest) {
    return ExperimentModel({.target = &target, .code = nullptr, .levels = &levels},
                           Angles(num_finest), nullptr)
        .caution();
  };
  EXPECT_NEAR(caution(Levels({2, 1.5}, 1.5), 20), 1.2 * std::sqrt(1.75), 1e-12);
  EXPECT_NEAR(caution(Levels({2, 1.5}, 1), 20), 1.2 * std::sqrt(3.5), 1e-12);
  EXPECT_NEAR(caution(Levels({2, 1.5}, 1), 5), 2.4, 1e-12);
}

// Many coarse evaluations and one at the target: what a number is there hangs on the discrepancy.
// The surrogate's variance counts 4.8² = 23 times in the misfit and 16 times in a tension, which is
// what one evaluation is good for.
TEST(ExperimentModel, OneFineEvaluationIsNoGroundForATension) {
  const Levels levels({2, 1}, 0);
  const ExperimentTarget target{.name = "box", .scalars = {{"angle_deg", 30, 0.01}}};
  OutputData data;
  for (int i = 0; i < 16; ++i) {
    const double u = (i + 0.5) / 16;
    data.points.push_back(Eigen::VectorXd::Constant(1, u));
    data.level.push_back(i == 8 ? 1 : 0);
    data.scalars.push_back({20 + 8 * u + (i == 8 ? 3 : 0)});
  }
  const ExperimentModel model({.target = &target, .code = nullptr, .levels = &levels}, data,
                              nullptr);
  EXPECT_NEAR(model.caution(), 4.8, 1e-12);
  const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, 0.1);
  const OutputMoments angle = model.Outputs(at);
  const double far = std::pow(Compress(target.scalars[0], 30) - angle.mean(0, 0), 2);
  const double variance = angle.variance(0, 0), open = model.open()[0];
  ASSERT_GT(variance, open);  // else nothing hangs on the caution
  EXPECT_NEAR(std::pow(model.Misfit(at), 2) * (23.04 * variance + open) / far, 1, 1e-9);
  EXPECT_NEAR(model.SquaredMisfit(at)[0] * (16 * variance + open) / far, 1, 1e-9);
}

// Nothing falls below 0.6, where a smooth surrogate swings under zero.
TEST(ExperimentModel, ANumberIsPredictedAsItCanBe) {
  const Levels levels({1}, 0);
  OutputData data;
  for (int i = 0; i < 12; ++i) {
    const double u = (i + 0.5) / 12;
    data.points.push_back(Eigen::VectorXd::Constant(1, u));
    data.level.push_back(0);
    data.scalars.push_back({u < 0.6 ? 0 : 20 * (u - 0.6)});
  }
  const Eigen::MatrixXd points = Eigen::VectorXd::LinSpaced(50, 0, 1);
  const auto model_of = [&](const ExperimentTarget& target) {
    return ExperimentModel({.target = &target, .code = nullptr, .levels = &levels}, data, nullptr);
  };
  const ExperimentTarget free{.name = "plate", .scalars = {{"mass_fallen_kg", 1, 0.5}}};
  ASSERT_LT(model_of(free).Scalars(points)[0].mean.minCoeff(), 0);
  const ExperimentTarget bounded{.name = "plate", .scalars = {{"mass_fallen_kg", 1, 0.5, 0}}};
  const ExperimentModel model = model_of(bounded);
  EXPECT_EQ(model.Scalars(points)[0].mean.minCoeff(), 0);
  EXPECT_EQ(model.Outputs(points).mean.minCoeff(), 0);
}

}  // namespace experiment_model_test
}  // namespace talus::optimizer
