#include "experiments/analysis/next/known.h"

namespace talus::analysis {
namespace {

// What is left of the variance once it is `after` is what an independent measurement with the
// difference of the precisions would leave. The posterior counts both by the weight.
Eigen::VectorXd OfTheDifference(const Known& known, const Eigen::VectorXd& after) {
  constexpr double kLeast = 1e-12;
  const Eigen::VectorXd more = known.weight * (after.cwiseInverse() - known.Now().cwiseInverse());
  return more.cwiseMax(kLeast).cwiseInverse();
}

}  // namespace

std::vector<Known> KnownExperiments(const Ground& ground, const optimizer::Posterior& posterior) {
  const std::vector<int> answered = ground.view.Answered();
  std::vector<Known> experiments;
  for (std::size_t i = 0; i < answered.size(); ++i) {
    Known known{.experiment = answered[i],
                .at = posterior.models()[i].Predict(ground.draws),
                .surrogate = {},
                .weight = posterior.models()[i].weight()};
    known.surrogate = SurrogateVariance(known.at);
    experiments.push_back(std::move(known));
  }
  return experiments;
}

double SurrogateShare(const std::vector<Known>& experiments) {
  double sum = 0;
  Eigen::Index num_outputs = 0;
  for (const Known& known : experiments) {
    sum += (known.surrogate.array() / known.Now().array()).sum();
    num_outputs += known.surrogate.size();
  }
  return sum / static_cast<double>(num_outputs);
}

optimizer::ExpectedLearning LearnWhenLess(const Ground& ground, const Known& known,
                                          const Eigen::VectorXd& less) {
  return ground.Learn(
      {.mean = known.at.mean, .variance = OfTheDifference(known, known.Now() - less)});
}

optimizer::ExpectedLearning LearnWithoutSurrogate(const Ground& ground,
                                                  const std::vector<Known>& experiments) {
  Eigen::Index num_outputs = 0;
  for (const Known& known : experiments) num_outputs += known.surrogate.size();
  Eigen::MatrixXd mean(ground.draws.rows(), num_outputs);
  Eigen::VectorXd variance(num_outputs);
  Eigen::Index first = 0;
  for (const Known& known : experiments) {
    const Eigen::Index count = known.surrogate.size();
    mean.middleCols(first, count) = known.at.mean;
    variance.segment(first, count) = OfTheDifference(known, known.Now() - known.surrogate);
    first += count;
  }
  return ground.Learn({.mean = mean, .variance = variance});
}

}  // namespace talus::analysis
