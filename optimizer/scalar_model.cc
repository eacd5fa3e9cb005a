#include "optimizer/scalar_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::optimizer {
namespace {

double Median(Eigen::VectorXd values) {
  const auto middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + middle, values.end());
  return values[middle];
}

}  // namespace

double ValueTransform::Forward(double value) const {
  return delta > 0 ? std::log(value - least + delta) : value;
}
double ValueTransform::Backward(double transformed) const {
  return delta > 0 ? std::exp(transformed) + least - delta : transformed;
}
double ValueTransform::BackwardSlope(double transformed) const {
  return delta > 0 ? std::exp(transformed) : 1;
}

ScalarFit FitScalar(const History& history, const ScalarModelOptions& options) {
  const surrogate::GaussianProcessOptions process_options{.trend = surrogate::Trend::kQuadratic,
                                                          .deterministic = options.deterministic,
                                                          .seed = options.seed};
  ScalarFit best{{},
                 surrogate::GaussianProcess::Fit(history.points, history.values, process_options)};
  if (!options.deterministic) return best;
  const double least = history.values.minCoeff();
  const double spread = Median(history.values) - least;
  if (!(spread > 0)) return best;
  double best_score = best.process.LogPosterior();
  for (const double fraction : {1.0, 0.1, 0.01}) {
    const ValueTransform transform{.least = least, .delta = fraction * spread};
    const Eigen::VectorXd values =
        history.values.unaryExpr([&](double v) { return transform.Forward(v); });
    auto process = surrogate::GaussianProcess::Fit(history.points, values, process_options);
    // dt/dv = 1 / (v - least + δ), so ln|dt/dv| = -t.
    const double score = process.LogPosterior() - values.sum();
    if (score > best_score) {
      best_score = score;
      best = {transform, std::move(process)};
    }
  }
  return best;
}

Moments ScalarModel::Predict(const Eigen::MatrixXd& points) const {
  const surrogate::Predictions raw = fit_.process.PredictAll(points);
  Moments moments{raw.mean, raw.variance.cwiseSqrt()};
  for (Eigen::Index i = 0; i < raw.mean.size(); ++i) {
    moments.mean[i] = fit_.transform.Backward(raw.mean[i]);
    moments.sd[i] *= fit_.transform.BackwardSlope(raw.mean[i]);
  }
  return moments;
}

Eigen::MatrixXd ScalarModel::Draw(const Eigen::MatrixXd& points, int num_draws,
                                  base::Random random) const {
  return fit_.process.Draw(points, num_draws, random).unaryExpr([this](double t) {
    return fit_.transform.Backward(t);
  });
}

double ScalarModel::NoiseSd(const Eigen::VectorXd& x) const {
  return std::sqrt(fit_.process.noise_variance()) *
         fit_.transform.BackwardSlope(fit_.process.Predict(x).mean);
}

Moments TransformedModel::Predict(const Eigen::MatrixXd& points) const {
  const surrogate::Predictions raw = process_.PredictAll(points);
  return {raw.mean, raw.variance.cwiseSqrt()};
}

MomentsGradient TransformedModel::PredictWithGradient(const Eigen::VectorXd& x) const {
  const surrogate::PredictionGradient raw = process_.PredictWithGradient(x);
  const double sd = std::sqrt(raw.value.variance);
  const Eigen::VectorXd sd_slope =
      sd > 0 ? Eigen::VectorXd(raw.variance / (2 * sd)) : Eigen::VectorXd::Zero(x.size());
  return {.mean = raw.value.mean, .sd = sd, .mean_slope = raw.mean, .sd_slope = sd_slope};
}

Eigen::MatrixXd TransformedModel::Draw(const Eigen::MatrixXd& points, int num_draws,
                                       base::Random random) const {
  return process_.Draw(points, num_draws, random);
}

double TransformedModel::NoiseSd(const Eigen::VectorXd&) const {
  return std::sqrt(process_.noise_variance());
}

}  // namespace talus::optimizer
