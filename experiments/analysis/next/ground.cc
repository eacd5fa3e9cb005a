#include "experiments/analysis/next/ground.h"

#include <utility>

namespace talus::analysis {

std::unique_ptr<optimizer::PosteriorStrategy> ModelOf(const campaign::JointView& view,
                                                      const std::vector<double>& scale_factors,
                                                      optimizer::ExperimentTarget target,
                                                      double target_factor) {
  const optimizer::PosteriorStrategyOptions options{
      .scale_factors = scale_factors, .target = target_factor, .seed = view.spec.seed};
  return std::make_unique<optimizer::PosteriorStrategy>(
      options, view.space.MakeDomain(),
      std::vector<optimizer::ExperimentTarget>{std::move(target)});
}

Eigen::VectorXd MeasuredBy(const Ground& ground, const optimizer::OutputPredictions& at, int runs,
                           double to_target) {
  const double share = 1.0 / runs + ground.model_error * ground.model_error;
  return share * to_target * at.single;
}

Eigen::VectorXd SurrogateVariance(const optimizer::OutputPredictions& at) {
  return at.variance.colwise().mean().transpose();
}

}  // namespace talus::analysis
