#include "optimizer/search/image_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel_for.h"
#include "base/random.h"
#include "optimizer/search/acquisition.h"
#include "surrogate/standard_deviation.h"

namespace talus::optimizer {
namespace {

using surrogate::StandardDeviation;

// Reconstruction errors below this share of the objective's standard deviation need no process.
constexpr double kSmallError = 1e-3;
constexpr double kHopeless = -1e6;  // below every logarithm of an improvement
// Posterior sd is inflated by this factor: point-estimated hyper-parameters and constant noise make
// it overconfident. Calibrated on synthetic heaps by bench/optimizers/range_coverage.cc.
constexpr double kImageInflation = 1.5;

// What the modes leave of each evaluation, a row each.
Eigen::MatrixXd Residuals(const CodedImages& data, const surrogate::PrincipalModes& modes) {
  Eigen::MatrixXd residuals(data.outputs.size(), modes.mean.size());
  for (int i = 0; i < data.outputs.size(); ++i) {
    residuals.row(i) = data.outputs.vectors[static_cast<std::size_t>(i)] - modes.mean;
  }
  return residuals - (residuals * modes.basis) * modes.basis.transpose();
}

// A share 1 - 1/n of the variance of n heaps lies among them and 1/n is their mean's.
Eigen::VectorXd Blur(const OutputModel& outputs, int num_heaps) {
  if (num_heaps <= 1) return {};
  return (1 - 1.0 / num_heaps) * outputs.ElementNoise();
}

std::optional<surrogate::GaussianProcess> FitReconstruction(const CodedImages& data,
                                                            const ImageModelOptions& options,
                                                            const ImageState* frozen) {
  surrogate::GaussianProcessOptions process{.deterministic = options.deterministic,
                                            .seed = options.seed};
  if (frozen != nullptr) {
    if (!frozen->reconstruction) return std::nullopt;
    process.frozen = frozen->reconstruction;
  } else if (data.reconstruction_errors.cwiseAbs().maxCoeff() <=
             kSmallError * StandardDeviation(data.values)) {
    return std::nullopt;
  }
  return surrogate::GaussianProcess::Fit(
      {.points = data.Points(), .values = data.reconstruction_errors}, process);
}

}  // namespace

Eigen::MatrixXd CodedImages::Points() const {
  Eigen::MatrixXd points(outputs.size(), outputs.points.front().size());
  for (int i = 0; i < outputs.size(); ++i) {
    points.row(i) = outputs.points[static_cast<std::size_t>(i)];
  }
  return points;
}

ImageModel::ImageModel(std::shared_ptr<const surrogate::FieldCode> code,
                       const FieldObjective& objective, const CodedImages& data,
                       const ImageModelOptions& options, const ImageState* frozen)
    : code_(std::move(code)),
      objective_(objective),
      outputs_({.deterministic = options.deterministic, .seed = options.seed}, data.outputs,
               frozen == nullptr ? nullptr : &frozen->outputs),
      functional_(code_, objective, outputs_.modes(), Blur(outputs_, objective.num_target_heaps)),
      reconstruction_(FitReconstruction(data, options, frozen)),
      deterministic_(options.deterministic),
      residuals_(Residuals(data, outputs_.modes())) {
  if (!objective_.target.empty()) target_ = code_->Encode(objective_.target);
}

ImageState ImageModel::state() const {
  return {
      .outputs = outputs_.state(),
      .reconstruction = reconstruction_ ? std::optional(reconstruction_->state()) : std::nullopt};
}

void ImageModel::ForEachPoint(Eigen::Index count, double num_images,
                              const std::function<void(Eigen::Index)>& body) const {
  base::ParallelFor({.num_items = count, .item_work = num_images * ImageWork()}, body);
}

double ImageModel::ImageWork() const {
  constexpr double kElementWork = 30;
  const Eigen::Index size = objective_.metric
                                ? static_cast<Eigen::Index>(objective_.width) * objective_.height
                                : outputs_.modes().basis.rows();
  return kElementWork * static_cast<double>(size);
}

double ImageModel::PredictionWork() const {
  const auto size = static_cast<double>(residuals_.rows());
  return num_modes() * size * (size / 2 + 40) + functional_.num_draws() * ImageWork();
}

double ImageModel::ExpectedOfOne(const Coefficients& at) const {
  if (objective_.metric) return functional_.Draws(at).mean();
  const surrogate::PrincipalModes& modes = outputs_.modes();
  return objective_.sad_scale *
         code_->ExpectedSad(functional_.OneHeap(at.mean),
                            modes.basis.cwiseAbs2() * at.variance + modes.discarded);
}

surrogate::Predictions ImageModel::ReconstructionError(const Eigen::MatrixXd& points) const {
  if (reconstruction_) return reconstruction_->PredictAll(points);
  return {.mean = Eigen::VectorXd::Zero(points.rows()),
          .variance = Eigen::VectorXd::Zero(points.rows())};
}

double ImageModel::Mean(const Eigen::VectorXd& x) const { return Means(x.transpose())[0]; }

Eigen::VectorXd ImageModel::Means(const Eigen::MatrixXd& points) const {
  const ModeMoments modes = outputs_.PredictModes(points);
  Eigen::VectorXd means = ReconstructionError(points).mean;
  ForEachPoint(points.rows(), 6, [&](Eigen::Index i) {
    means[i] += functional_.Expected({modes.mean.row(i), modes.variance.row(i)});
  });
  return means;
}

Moments ImageModel::Predict(const Eigen::MatrixXd& points) const {
  const ModeMoments modes = outputs_.PredictModes(points);
  const surrogate::Predictions error = ReconstructionError(points);
  Moments moments{.mean = error.mean, .sd = Eigen::VectorXd(points.rows())};
  ForEachPoint(points.rows(), 6 + functional_.num_draws(), [&](Eigen::Index i) {
    const Coefficients at{modes.mean.row(i), modes.variance.row(i)};
    const Moment of_images = functional_.MomentsAt(at);
    moments.mean[i] += of_images.mean;
    moments.sd[i] = std::sqrt(of_images.sd * of_images.sd + error.variance[i]);
  });
  return moments;
}

Sensitivities ImageModel::SensitivitiesAt(const Eigen::MatrixXd& points) const {
  const ModeMoments modes = outputs_.PredictModes(points);
  Sensitivities result{.slope = Eigen::MatrixXd(points.rows(), num_modes()),
                       .curvature = Eigen::MatrixXd(points.rows(), num_modes())};
  ForEachPoint(points.rows(), 6 + 12.0 * num_modes(), [&](Eigen::Index i) {
    Coefficients at{modes.mean.row(i), modes.variance.row(i)};
    const double here = functional_.Expected(at);
    for (Eigen::Index k = 0; k < num_modes(); ++k) {
      const double middle = at.mean[k];
      const double step = std::sqrt(std::max(at.variance[k], std::numeric_limits<double>::min()));
      at.mean[k] = middle + step;
      const double above = functional_.Expected(at);
      at.mean[k] = middle - step;
      const double below = functional_.Expected(at);
      result.slope(i, k) = (above - below) / (2 * step);
      result.curvature(i, k) = (above - 2 * here + below) / (step * step);
      at.mean[k] = middle;
    }
  });
  return result;
}

double ImageModel::LogImprovementOfDraws(const Eigen::VectorXd& draws, double incumbent) const {
  const Eigen::ArrayXd gain = incumbent - draws.array();
  const double mean_gain = gain.max(0).mean();
  if (mean_gain > 0) return std::log(mean_gain);
  return kHopeless / 2 + gain.maxCoeff() / std::max(std::abs(incumbent), 1e-300);
}

// What Σ |Δ| over the columns can be at most for draws within four standard deviations: no image
// differs from the mean one by more.
double ImageModel::Reach(const Coefficients& at) const {
  const Eigen::VectorXd sd = (outputs_.modes().basis.cwiseAbs2() * at.variance).cwiseSqrt();
  return 4 * objective_.sad_scale * sd.sum();
}

Eigen::VectorXd ImageModel::LogImprovement(const Eigen::MatrixXd& points, double incumbent,
                                           double noise) const {
  const ModeMoments modes = outputs_.PredictModes(points);
  const surrogate::Predictions error = ReconstructionError(points);
  Eigen::VectorXd result(points.rows());
  ForEachPoint(points.rows(), 1 + functional_.num_draws(), [&](Eigen::Index i) {
    result[i] = LogImprovementAt(
        {modes.mean.row(i), modes.variance.row(i)},
        {.value = incumbent - error.mean[i], .noise = noise, .error_variance = error.variance[i]});
  });
  return result;
}

double ImageModel::LogImprovementAt(const Coefficients& at, const Goal& goal) const {
  const double reach = objective_.metric ? std::numeric_limits<double>::infinity() : Reach(at);
  const double excess =
      objective_.metric ? 0 : functional_.Value(functional_.MeanImage(at.mean)) - goal.value;
  if (excess > reach) return kHopeless - excess / std::max(reach, 1e-300);
  const Eigen::VectorXd draws = functional_.Draws(at);
  if (!(goal.noise > 0)) return LogImprovementOfDraws(draws, goal.value);
  const double sd_of_draws = StandardDeviation(draws);
  const double sd = std::sqrt(sd_of_draws * sd_of_draws + goal.error_variance);
  return AugmentedLogExpectedImprovement(draws.mean(), sd, goal.value, goal.noise).value;
}

Coefficients ImageModel::Nearest(const ModeMoments& modes) const {
  Eigen::Index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < modes.mean.rows(); ++i) {
    const double gap =
        (target_ - functional_.MeanImage(modes.mean.row(i).transpose())).squaredNorm();
    if (gap >= least) continue;
    least = gap;
    nearest = i;
  }
  return {modes.mean.row(nearest), modes.variance.row(nearest)};
}

// The target's heaps are as noisy as evaluations. Where even the best image misses the target by
// more than that, as one of another powder than any simulated may, the errors are larger by as
// much.
Eigen::MatrixXd ImageModel::TargetErrors(const Coefficients& nearest, int num_draws,
                                         base::Random random) const {
  const Eigen::MatrixXd& basis = outputs_.modes().basis;
  const double share = 1.0 / objective_.num_target_heaps;
  const double expected =
      (basis.cwiseAbs2() * nearest.variance + share * outputs_.ElementNoise()).sum();
  const double missed = (target_ - functional_.MeanImage(nearest.mean)).squaredNorm() / expected;
  const double scale = kImageInflation * std::sqrt(std::max(1.0, missed) * share);
  const Eigen::VectorXd sd = scale * outputs_.ModeNoise().cwiseSqrt();
  const double of_one = scale / std::sqrt(static_cast<double>(residuals_.rows()));
  Eigen::MatrixXd errors(num_draws, basis.rows());
  for (Eigen::Index d = 0; d < num_draws; ++d) {
    const Eigen::VectorXd in_modes =
        sd.unaryExpr([&](double one) { return one * random.Normal(); });
    const Eigen::VectorXd beside =
        Eigen::VectorXd::NullaryExpr(residuals_.rows(), [&] { return of_one * random.Normal(); });
    errors.row(d) = basis * in_modes + residuals_.transpose() * beside;
  }
  return errors;
}

// |image - (target + e)| = |(image - e) - target|: an error of the target is the same to each image
// of a draw.
Eigen::MatrixXd ImageModel::Draw(const Eigen::MatrixXd& points, int num_draws,
                                 base::Random random) const {
  std::vector<Eigen::MatrixXd> modes = outputs_.DrawModes(points, num_draws, random.Next());
  Eigen::MatrixXd draws = reconstruction_ ? reconstruction_->Draw(points, num_draws, random)
                                          : Eigen::MatrixXd::Zero(num_draws, points.rows());
  const bool exact = objective_.num_target_heaps == 0 || target_.size() == 0;
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(exact ? 0 : num_draws, target_.size());
  if (!exact) {
    const ModeMoments at = outputs_.PredictModes(points);
    errors = TargetErrors(Nearest(at), num_draws,
                          base::Random(random.Next(), base::Stream("target errors")));
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const Eigen::RowVectorXd mean = at.mean.col(column).transpose();
      modes[k] = (kImageInflation * (modes[k].rowwise() - mean)).rowwise() + mean;
    }
  }
  ForEachPoint(draws.rows(), static_cast<double>(draws.cols()), [&](Eigen::Index d) {
    Eigen::VectorXd coefficients(static_cast<Eigen::Index>(modes.size()));
    for (Eigen::Index i = 0; i < draws.cols(); ++i) {
      for (std::size_t k = 0; k < modes.size(); ++k) {
        coefficients[static_cast<Eigen::Index>(k)] = modes[k](d, i);
      }
      Eigen::VectorXd vector = functional_.MeanImage(coefficients);
      if (!exact) vector -= errors.row(d).transpose();
      draws(d, i) += functional_.Value(vector);
    }
  });
  return draws;
}

double ImageModel::NoiseSd(const Eigen::VectorXd& x) const {
  if (deterministic_) return 0;
  const ModeMoments modes = outputs_.PredictModes(x.transpose());
  const double error = reconstruction_ ? reconstruction_->noise_variance() : 0;
  const double sd_of_draws = functional_.SdOfDraws({modes.mean.row(0), outputs_.ModeNoise()});
  return std::sqrt(sd_of_draws * sd_of_draws + error);
}

Eigen::VectorXd ImageModel::LeaveOneOut() const {
  const ModeMoments modes = outputs_.LeaveModesOut();
  Eigen::VectorXd values = reconstruction_ ? reconstruction_->LeaveOneOut().mean
                                           : Eigen::VectorXd::Zero(modes.mean.rows());
  ForEachPoint(values.size(), 6, [&](Eigen::Index i) {
    values[i] += ExpectedOfOne({modes.mean.row(i), modes.variance.row(i)});
  });
  return values;
}

void ImageModel::AddFantasy(const Eigen::VectorXd& x) {
  outputs_.AddFantasy(x);
  if (reconstruction_) reconstruction_->AddFantasy({.x = x});
}

}  // namespace talus::optimizer
