// What is known before a further measurement: the draws of a posterior, or of what is searched.
#pragma once

#include <memory>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"
#include "optimizer/posterior/expected_learning.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::analysis {

struct Ground {
  const campaign::JointView& view;
  double temper = 1;       // of all variances: the posterior's
  Eigen::MatrixXd draws;   // equally likely, one a row
  double model_error = 1;  // of a test that was not made: the tests' that were [rms]
  // Share of its surrogate's error in the variances of a further test's outputs, in [0, 1).
  double surrogate_share = 0;
  Eigen::VectorXd goal{};      // what a prediction gives at each draw; empty: the parameters count
  Eigen::MatrixXd supposed{};  // sets to take for the truth, one a row; none: the draws

  // The variance of each output once measured is that before tempering.
  optimizer::ExpectedLearning Learn(optimizer::PredictedMeasurement measurement) const {
    measurement.variance *= temper;
    return optimizer::Learn(draws, measurement, view.spec.seed,
                            {.goal = goal, .nuisances = view.space.Nuisances()});
  }
};

// A model of a test that was not made, simulated at these scale factors and asked at
// `target_factor`, 0 for the finest; its target is what the simulations show on average.
std::unique_ptr<optimizer::PosteriorStrategy> ModelOf(const campaign::JointView& view,
                                                      const std::vector<double>& scale_factors,
                                                      optimizer::ExperimentTarget target,
                                                      double target_factor = 0);

// Variance of each output as measured by so many runs, with the model's error; `to_target` is the
// noise variance at the target over that of the simulations.
Eigen::VectorXd MeasuredBy(const Ground& ground, const optimizer::OutputPredictions& at, int runs,
                           double to_target);

// The surrogate's variance of each output, mean over the draws.
Eigen::VectorXd SurrogateVariance(const optimizer::OutputPredictions& at);

}  // namespace talus::analysis
