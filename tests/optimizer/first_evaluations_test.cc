#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "base/random.h"
#include "optimizer/strategy/posterior_strategy.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace first_evaluations_test {

// Tests of one number each, the sum and the difference of two parameters.
struct Search {
  std::vector<double> factors{1};
  int num_experiments = 1;
  std::function<bool(const Eigen::VectorXd&)> feasible{};

  std::unique_ptr<PosteriorStrategy> Make() const {
    std::vector<ExperimentTarget> targets{{.name = "sum", .scalars = {{"sum", 0.8, 0.02}}},
                                          {.name = "difference", .scalars = {{"d", 1.1, 0.02}}}};
    targets.resize(static_cast<std::size_t>(num_experiments));
    return std::make_unique<PosteriorStrategy>(PosteriorStrategyOptions{.scale_factors = factors},
                                               Domain{.num_parameters = 2, .feasible = feasible},
                                               targets);
  }
};

Observation Simulate(const Proposal& p, int run) {
  base::Random random(3, base::Stream("run"), static_cast<std::uint64_t>(run));
  const double exact = p.experiment == 0 ? p.point.sum() : 1 + p.point[0] - p.point[1];
  return {.point = p.point,
          .experiment = p.experiment,
          .scale_factor = p.scale_factor,
          .scalars = {exact + 0.02 * random.Normal()}};
}

int NumSetsOf(const std::vector<Proposal>& proposals) {
  std::vector<Eigen::VectorXd> sets;
  for (const Proposal& p : proposals) {
    if (std::ranges::none_of(sets,
                             [&](const auto& set) { return surrogate::SamePoint(set, p.point); })) {
      sets.push_back(p.point);
    }
  }
  return static_cast<int>(sets.size());
}

std::vector<Proposal> DesignOf(PosteriorStrategy& strategy) {
  std::vector<Proposal> design;
  for (int i = 0; i < 40; ++i) {
    const Proposal p = strategy.AskAt(1, {}).front();
    if (p.origin == Origin::kDesign) design.push_back(p);
    strategy.Tell(Simulate(p, 100 + i));
  }
  return design;
}

// Twelve simulations of one set were a whole design, after which nothing was left to be learnt.
TEST(FirstEvaluations, RunsOfOneSetForTheNoiseTakeNothingFromTheDesign) {
  const Search search;
  const auto without = search.Make();
  const int usual = NumSetsOf(DesignOf(*without));
  for (const int num_noise : {2, 12}) {
    const auto strategy = search.Make();
    for (int i = 0; i < num_noise; ++i) {
      strategy->Tell(Simulate({.point = Eigen::Vector2d(0.5, 0.5), .scale_factor = 1}, i));
    }
    EXPECT_FALSE(strategy->WhyStop());
    EXPECT_EQ(NumSetsOf(DesignOf(*strategy)), usual) << num_noise;
  }
}

TEST(FirstEvaluations, AnAddedTestIsSimulatedAtEightSetsHoweverOftenEach) {
  const Search search{.num_experiments = 2};
  const auto strategy = search.Make();
  const auto first = Search{}.Make();
  for (int i = 0; i < 24; ++i) {
    const Proposal p = first->AskAt(1, {}).front();
    first->Tell(Simulate(p, i));
    strategy->Tell(Simulate(p, i));
  }
  std::vector<Proposal> added;
  for (int i = 0; i < 10; ++i) {
    const Proposal p = strategy->AskAt(1, {}).front();
    if (p.origin == Origin::kDesign) added.push_back(p);
    for (int k = 0; k < 4; ++k) strategy->Tell(Simulate(p, 100 + 4 * i + k));
  }
  EXPECT_EQ(NumSetsOf(added), 8);
  for (const Proposal& p : added) EXPECT_EQ(p.experiment, 1);
}

TEST(FirstEvaluations, AFinerScaleFactorIsLearntAtThreeSets) {
  const auto strategy = Search{.factors = {2, 1.5, 1}}.Make();
  std::vector<Proposal> finer[2];
  for (int i = 0; finer[1].size() < 3 && i < 40; ++i) {
    const Proposal p = strategy->AskAt(1, {}).front();
    for (int k = 0; k < 3; ++k) strategy->Tell(Simulate(p, 3 * i + k));
    if (p.scale_factor < 2) finer[p.scale_factor < 1.5].push_back(p);
    if (!finer[1].empty()) {
      EXPECT_GE(NumSetsOf(finer[0]), 3);
    }
  }
  EXPECT_EQ(NumSetsOf(finer[1]), 3);
}

TEST(FirstEvaluations, WhatAConstraintForbidsIsInNoRegion) {
  const Search search{.feasible = [](const Eigen::VectorXd& x) { return x[1] <= x[0]; }};
  const auto strategy = search.Make();
  DesignOf(*strategy);
  const Eigen::Matrix2d points{{0.5, 0.3}, {0.3, 0.5}};  // equal sums
  const Eigen::VectorXd levels = strategy->CredibleLevels(points).value();
  EXPECT_LT(levels[0], 0.9);
  EXPECT_EQ(levels[1], 1);
}

}  // namespace first_evaluations_test
}  // namespace talus::optimizer
