// An experiment as the posterior knows it, and what would be learnt if less were unknown of it.
#pragma once

#include <vector>

#include "experiments/analysis/next/ground.h"

namespace talus::analysis {

// What hides the truth from each of its outputs.
struct Known {
  int experiment = 0;
  optimizer::OutputPredictions at;
  Eigen::VectorXd surrogate;  // variance, mean over the draws
  double weight = 1;          // by which the posterior counts its misfits, > 0

  Eigen::VectorXd Now() const { return surrogate + at.measured + at.model; }
};

// Those that the campaign's answer meets.
std::vector<Known> KnownExperiments(const Ground& ground, const optimizer::Posterior& posterior);

// The surrogate's share of the variances of their outputs: the mean over all of them.
double SurrogateShare(const std::vector<Known>& experiments);

// With `less` of the variance of each output.
optimizer::ExpectedLearning LearnWhenLess(const Ground& ground, const Known& known,
                                          const Eigen::VectorXd& less);

// Had every set been simulated, in every experiment.
optimizer::ExpectedLearning LearnWithoutSurrogate(const Ground& ground,
                                                  const std::vector<Known>& experiments);

}  // namespace talus::analysis
