// What the posterior needs to judge a further measurement.
#pragma once

#include <memory>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"
#include "optimizer/posterior/expected_learning.h"
#include "optimizer/posterior/posterior.h"

namespace talus::analysis {

struct Ground {
  const campaign::JointView& view;
  const optimizer::Posterior& posterior;
  Eigen::MatrixXd draws;   // equally likely, one a row
  double model_error = 1;  // PosteriorOptions

  // `variance` of each output once measured, before tempering.
  optimizer::ExpectedLearning Learn(const Eigen::MatrixXd& mean,
                                    const Eigen::VectorXd& variance) const {
    return optimizer::Learn(draws, {.mean = mean, .variance = posterior.temper() * variance},
                            view.spec.seed);
  }
};

// A model of a test that was not made, simulated at these scale factors; its target is what the
// simulations show on average.
std::unique_ptr<optimizer::PosteriorStrategy> ModelOf(const campaign::JointView& view,
                                                      const std::vector<double>& scale_factors,
                                                      optimizer::ExperimentTarget target);

// Variance of each output as measured by so many runs, with the model's error; `to_target` is the
// noise variance at the target over that of the simulations.
Eigen::VectorXd MeasuredBy(const Ground& ground, const optimizer::OutputPredictions& at, int runs,
                           double to_target);

double MeanOf(const std::vector<double>& values);

}  // namespace talus::analysis
