#include "experiments/analysis/predict/number_surrogate.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::analysis {
namespace {

// Draws that have the number.
surrogate::Evaluations EvaluationsOf(const Prediction& prediction, const PredictedNumber& number,
                                     const optimizer::ParameterSpace& space) {
  std::vector<std::size_t> draws;
  for (std::size_t d = 0; d < number.by_draw.size(); ++d) {
    if (std::isfinite(number.by_draw[d])) draws.push_back(d);
  }
  const std::vector<int> free = space.Free();
  surrogate::Evaluations evaluations{
      .points = Eigen::MatrixXd(static_cast<Eigen::Index>(draws.size()),
                                static_cast<Eigen::Index>(free.size())),
      .values = Eigen::VectorXd(static_cast<Eigen::Index>(draws.size()))};
  for (std::size_t row = 0; row < draws.size(); ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    evaluations.values[i] = number.by_draw[draws[row]];
    for (std::size_t k = 0; k < free.size(); ++k) {
      const optimizer::Parameter& p = space.parameters[static_cast<std::size_t>(free[k])];
      evaluations.points(i, static_cast<Eigen::Index>(k)) =
          p.ToUnit(prediction.draws[draws[row]].values[k]);
    }
  }
  return evaluations;
}

// Scatter of a draw's mean over the spread of the means; as is usual where no set was run twice.
surrogate::LogNormal NoisePrior(const Prediction& prediction, const PredictedNumber& number,
                                double spread) {
  constexpr double kLeast = 1e-3;
  constexpr double kKnown = 0.2;  // sd of its logarithm, by two dozen degrees of freedom
  if (!std::isfinite(number.run_sd)) return surrogate::HyperPriors{}.noise.front();
  const double runs =
      static_cast<double>(prediction.num_runs) / static_cast<double>(prediction.draws.size());
  return {.median = std::clamp(number.run_sd / std::sqrt(runs) / spread, kLeast, 1.0),
          .log_sd = kKnown};
}

}  // namespace

std::optional<NumberSurrogate> NumberSurrogate::Fit(const Prediction& prediction,
                                                    const PredictedNumber& number,
                                                    const optimizer::ParameterSpace& space) {
  const surrogate::Evaluations evaluations = EvaluationsOf(prediction, number, space);
  const Eigen::VectorXd& values = evaluations.values;
  if (values.size() < kFewest) return std::nullopt;
  NumberSurrogate fitted;
  fitted.constant_ = values.mean();
  const Eigen::ArrayXd off = values.array() - fitted.constant_;
  const double spread = std::sqrt(off.square().mean());
  if (!(spread > 1e-12 * std::abs(fitted.constant_))) return fitted;
  fitted.process_ = surrogate::GaussianProcess::Fit(
      evaluations,
      {.trend = surrogate::Trend::kQuadratic,
       .priors = surrogate::PriorsOfOutputs({NoisePrior(prediction, number, spread)})});
  const Eigen::VectorXd told = fitted.process_->values();
  const Eigen::VectorXd missed = fitted.process_->LeaveOneOut().mean - told;
  fitted.left_out_error_ = std::sqrt(missed.squaredNorm() / static_cast<double>(missed.size()));
  return fitted;
}

surrogate::Predictions NumberSurrogate::At(const Eigen::MatrixXd& points) const {
  if (process_) return process_->PredictAll(points);
  return {.mean = Eigen::VectorXd::Constant(points.rows(), constant_),
          .variance = Eigen::VectorXd::Zero(points.rows())};
}

}  // namespace talus::analysis
