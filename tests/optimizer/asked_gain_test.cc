// What simulations are worth to the parameters asked for.
#include "optimizer/posterior/asked_gain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "optimizer/posterior/posterior.h"

namespace talus::optimizer {
namespace asked_gain_test {

const Levels kLevels({1}, 1);

// One number that a parameter and a second one move alike, seen at a few sets with noise.
struct Sum {
  explicit Sum(double nuisance_sd, double weight = 1) {
    target.weight = weight;
    if (nuisance_sd <= 0) return;
    domain.nuisances = {1};
    domain.prior.Add(1, {.low = 0, .high = 1}, {.mean = 0.5, .sd = nuisance_sd});
  }
  Posterior Make() const {
    OutputData data;
    base::Random random(3, base::Stream("sets"));
    for (int i = 0; i < 9; ++i) {
      data.points.push_back(Eigen::Vector2d(random.Uniform(), random.Uniform()));
      data.level.push_back(0);
      data.scalars.push_back({2 + data.points.back().sum() + 0.1 * random.Normal()});
    }
    std::vector<ExperimentModel> models;
    models.emplace_back(
        ExperimentModel::Setup{.target = &target, .code = nullptr, .levels = &kLevels}, data,
        nullptr);
    return {std::move(models), {data}};
  }

  ExperimentTarget target{.name = "sum", .scalars = {{"sum", 3, 0.01}}};
  Domain domain{.num_parameters = 2};
};

const Eigen::MatrixXd kDraws = Eigen::MatrixXd::Constant(1, 2, 0.5);

TEST(AskedGain, WithoutNuisancesItIsThatOfTheOutputs) {
  const Sum sum(0);
  const Posterior posterior = sum.Make();
  const AskedGain gain(posterior, sum.domain, kDraws);
  EXPECT_EQ(gain.OfAll(), posterior.models()[0].GainOfAll(kDraws));
  EXPECT_EQ(gain.OfOne(0, kDraws), posterior.models()[0].Gains(kDraws, kDraws));
}

// With one output, ln det(I + UᵀC⁻¹U) makes it ½ ln((V + B + u²)/(V' + B + u²)).
TEST(AskedGain, WhatANuisanceHidesAnywayIsNotWorthASimulation) {
  const Sum sum(0.1);
  const Posterior posterior = sum.Make();
  const ExperimentModel& model = posterior.models()[0];
  const AskedGain gain(posterior, sum.domain, kDraws);
  const double v = model.Outputs(kDraws).variance(0, 0);
  const double b = model.open()[0];
  Eigen::MatrixXd above = kDraws;
  Eigen::MatrixXd below = kDraws;
  above(0, 1) = 0.6;
  below(0, 1) = 0.4;
  const double u = 0.1 / 0.2 * (model.Outputs(above).mean - model.Outputs(below).mean)(0, 0);
  // The prior's sd inside the cube, from 2000 draws of it, is 0.1 within 3 %.
  const double expected = 0.5 * std::log((v + b + u * u) / (b + u * u));
  EXPECT_NEAR(gain.OfAll()[0], expected, 0.07 * expected);
  EXPECT_LT(gain.OfAll()[0], model.GainOfAll(kDraws)[0]);
  const double one = gain.OfOne(0, kDraws)(0, 0);
  EXPECT_GT(one, 0);
  EXPECT_LT(one, gain.OfAll()[0]);
  EXPECT_LT(one, model.Gains(kDraws, kDraws)(0, 0));
}

// It was negative where a nuisance hides most, and what taught least looked best.
TEST(AskedGain, AnExperimentOfLittleWeightGainsLittleButNeverLessThanNothing) {
  double last = 0;
  for (const double weight : {0.1, 0.5, 1.0}) {
    const Sum sum(0.3, weight);
    const Posterior posterior = sum.Make();
    const AskedGain gain(posterior, sum.domain, kDraws);
    EXPECT_GT(gain.OfAll()[0], last);
    EXPECT_GT(gain.OfOne(0, kDraws)(0, 0), 0);
    EXPECT_LT(gain.OfOne(0, kDraws)(0, 0), gain.OfAll()[0]);
    last = gain.OfAll()[0];
  }
}

}  // namespace asked_gain_test
}  // namespace talus::optimizer
