#include "optimizer/search/scalar_model.h"

#include <algorithm>
#include <cmath>

#include "base/median.h"

namespace talus::optimizer {
namespace {

// The largest of 8 · 2^(k/2), rounded (8, 11, 16, 23, 32, …), whose unrounded value is at most n: 8
// for 11 evaluations, since 8 √2 = 11.3. n itself below 8.
int MilestoneBefore(int n) {
  if (n < 8) return n;
  const double steps = std::floor(2 * std::log2(n / 8.0) + 1e-9);
  const int size = static_cast<int>(std::lround(8 * std::exp2(steps / 2)));
  return std::min(size, n);
}

ValueTransform TransformOf(const Eigen::VectorXd& values, double delta_share) {
  const double least = values.minCoeff();
  return {.least = least, .delta = delta_share * (base::Median(values) - least)};
}

surrogate::GaussianProcessOptions ProcessOptions(bool deterministic, std::uint64_t seed) {
  return {.trend = surrogate::Trend::kQuadratic,
          .warp_inputs = true,
          .deterministic = deterministic,
          .seed = seed};
}

Eigen::VectorXd Transformed(const Eigen::VectorXd& values, const ValueTransform& transform) {
  return values.unaryExpr([&](double v) { return transform.Forward(v); });
}

// Log densities of the values, not of their transforms t: ln|dt/dv| = -t is added for each.
double Jacobian(const Eigen::VectorXd& transforms, bool transformed) {
  return transformed ? -transforms.sum() : 0;
}

// Each predicted from the others. Near an exact minimum ln(v - least + δ) falls the steeper the
// smaller δ is, and the Jacobian would hide that no process can follow it: so values count as
// known to `resolution` only.
double LeftOutDensity(const surrogate::GaussianProcess& process, bool transformed,
                      double resolution) {
  const surrogate::Predictions left_out = process.LeaveOneOut();
  const Eigen::ArrayXd values = process.values();
  Eigen::ArrayXd variance = left_out.variance;
  if (transformed) variance += (resolution * (-values).exp()).square();
  const double density =
      -0.5 * ((values - left_out.mean.array()).square() / variance + variance.log()).sum();
  return density + Jacobian(values, transformed);
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

ScalarFit ScalarFitter::Fit(const History& history, bool deterministic, FitFor purpose) {
  const int size = MilestoneBefore(history.size());
  if (milestone_.num_evaluations != size || milestone_.deterministic != deterministic) {
    ReachMilestone(history, size, deterministic);
  }
  const Choice& choice = milestone_.choices[static_cast<std::size_t>(purpose)];
  const ValueTransform transform = TransformOf(history.values, choice.delta_share);
  surrogate::GaussianProcessOptions options = ProcessOptions(deterministic, seed_);
  options.start = choice.hyper;
  options.effort.num_starts = 1;
  options.effort.num_searches = 1;
  return {
      transform,
      surrogate::GaussianProcess::Fit(
          {.points = history.points, .values = Transformed(history.values, transform)}, options),
      deterministic};
}

void ScalarFitter::ReachMilestone(const History& history, int num_evaluations, bool deterministic) {
  const Eigen::MatrixXd points = history.points.topRows(num_evaluations);
  const Eigen::VectorXd values = history.values.head(num_evaluations);
  milestone_ = {.num_evaluations = num_evaluations, .deterministic = deterministic};
  surrogate::GaussianProcessOptions options = ProcessOptions(deterministic, seed_);
  if (deterministic) options.effort.num_searches = 1;  // four transforms to fit
  double resolution = 0;
  for (const double share : {0.0, 1.0, 0.1, 0.01}) {
    if (share > 0 && !deterministic) break;
    const ValueTransform transform = TransformOf(values, share);
    if (share > 0 && transform.delta == 0) break;  // constant values
    const Eigen::VectorXd transforms = Transformed(values, transform);
    const auto process =
        surrogate::GaussianProcess::Fit({.points = points, .values = transforms}, options);
    if (share == 0) resolution = std::sqrt(process.noise_variance());
    const double likelihood = process.LogPosterior() + Jacobian(transforms, share > 0);
    const double left_out = LeftOutDensity(process, share > 0, resolution);
    const std::array merits{likelihood, left_out};  // by FitFor
    for (std::size_t purpose = 0; purpose < merits.size(); ++purpose) {
      Choice& choice = milestone_.choices[purpose];
      if (!(merits[purpose] > choice.merit)) continue;
      choice = {.delta_share = share, .hyper = process.state().hyper, .merit = merits[purpose]};
    }
  }
}

Moments ScalarModel::Predict(const Eigen::MatrixXd& points) const {
  const surrogate::Predictions raw = fit_.process.PredictAll(points);
  Moments moments{raw.mean, raw.variance.cwiseSqrt()};
  for (Eigen::Index i = 0; i < raw.mean.size(); ++i) {
    moments.mean[i] = fit_.transform.Backward(raw.mean[i]);
    moments.sd[i] *= inflation_ * fit_.transform.BackwardSlope(raw.mean[i]);
  }
  return moments;
}

Eigen::MatrixXd ScalarModel::Draw(const Eigen::MatrixXd& points, int num_draws,
                                  base::Random random) const {
  Eigen::MatrixXd draws = fit_.process.Draw(points, num_draws, random);
  const Eigen::RowVectorXd mean = fit_.process.PredictAll(points).mean.transpose();
  draws = (inflation_ * (draws.rowwise() - mean)).rowwise() + mean;
  return draws.unaryExpr([this](double t) { return fit_.transform.Backward(t); });
}

double ScalarModel::NoiseSd(const Eigen::VectorXd& x) const {
  if (fit_.deterministic) return 0;
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

double TransformedModel::PredictionWork() const {
  const auto size = static_cast<double>(process_.num_points());
  return size * (size + 40);  // two triangular solutions, and a row of covariances
}

double TransformedModel::NoiseSd(const Eigen::VectorXd&) const {
  return std::sqrt(process_.noise_variance());
}

}  // namespace talus::optimizer
