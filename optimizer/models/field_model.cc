#include "optimizer/models/field_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel_for.h"
#include "base/random.h"
#include "optimizer/acquisition/acquisition.h"
#include "optimizer/models/mirrored_normals.h"
#include "surrogate/standard_deviation.h"

namespace talus::optimizer {
namespace {

using surrogate::StandardDeviation;

constexpr int kNumDraws = 16;
// Without noise every mode that is more than rounding is signal.
constexpr int kModesIfDeterministic = 12;
// Reconstruction errors below this share of the objective's standard deviation need no process.
constexpr double kSmallError = 1e-3;
// Every evaluation brings as many numbers as there are modes, so they support stronger input
// warping than one number would.
constexpr surrogate::HyperPriors kNoisyPriors{.length = {.median = 0.7, .log_sd = 0.4},
                                              .warp_sd = 2};
constexpr double kHopeless = -1e6;  // below every logarithm of an improvement
// Posterior sd is inflated by this factor: point-estimated hyper-parameters and constant noise make
// it overconfident. Calibrated on synthetic heaps by bench/optimizers/range_coverage.cc.
constexpr double kInflation = 1.5;

// The weak modes are noise until there are evaluations enough to tell.
int ModesIfNoisy(Eigen::Index num_evaluations) {
  constexpr int kFewest = 6;
  constexpr int kMost = 10;
  constexpr int kEnoughForFewest = 40;  // evaluations; one more mode for every ten beyond
  return std::clamp(kFewest + static_cast<int>(num_evaluations - kEnoughForFewest) / 10, kFewest,
                    kMost);
}

surrogate::ModeOptions OptionsOf(const CodedFields& data, const FieldModelOptions& options,
                                 const FieldState* frozen) {
  surrogate::ModeOptions modes;
  modes.max_modes =
      options.deterministic ? kModesIfDeterministic : ModesIfNoisy(data.values.size());
  modes.process.trend = surrogate::Trend::kQuadratic;
  modes.process.deterministic = options.deterministic;
  modes.process.seed = options.seed;
  modes.process.warp_inputs = !options.deterministic;
  if (!options.deterministic) modes.process.priors = kNoisyPriors;
  if (frozen != nullptr) modes.frozen = frozen->modes;
  return modes;
}

std::optional<surrogate::GaussianProcess> FitReconstruction(const CodedFields& data,
                                                            const FieldModelOptions& options,
                                                            const FieldState* frozen) {
  surrogate::GaussianProcessOptions process{.deterministic = options.deterministic,
                                            .seed = options.seed};
  if (frozen != nullptr) {
    if (!frozen->reconstruction) return std::nullopt;
    process.frozen = frozen->reconstruction;
  } else if (data.reconstruction_errors.cwiseAbs().maxCoeff() <=
             kSmallError * StandardDeviation(data.values)) {
    return std::nullopt;
  }
  return surrogate::GaussianProcess::Fit(data.points, data.reconstruction_errors, process);
}

}  // namespace

FieldModel::FieldModel(std::shared_ptr<const surrogate::FieldCode> code,
                       const FieldObjective& objective, const CodedFields& data,
                       const FieldModelOptions& options, const FieldState* frozen)
    : code_(std::move(code)),
      objective_(objective),
      modes_(
          surrogate::ModeProcess::Fit(data.points, data.vectors, OptionsOf(data, options, frozen))),
      reconstruction_(FitReconstruction(data, options, frozen)),
      residuals_(data.vectors.rowwise() - modes_.modes().mean.transpose()),
      normals_(MirroredNormals(kNumDraws, modes_.modes().basis.cols(),
                               base::Random(options.seed, base::Stream("field draws")))) {
  const Eigen::MatrixXd& basis = modes_.modes().basis;
  residuals_ -= (residuals_ * basis) * basis.transpose();
  if (objective_.num_target_heaps > 1) {
    // Of n heaps, a share 1 - 1/n of the variance lies among them and 1/n is their mean's.
    blur_ = (1 - 1.0 / objective_.num_target_heaps) * modes_.ElementNoise();
  }
  if (!objective_.target.empty()) target_ = code_->Encode(objective_.target);
}

int FieldModel::num_parameters() const { return modes_.num_parameters(); }

FieldState FieldModel::state() const {
  return {
      .modes = modes_.state(),
      .reconstruction = reconstruction_ ? std::optional(reconstruction_->state()) : std::nullopt};
}

Eigen::VectorXd FieldModel::Vector(const Eigen::VectorXd& coefficients) const {
  return modes_.modes().mean + modes_.modes().basis * coefficients;
}

Eigen::VectorXd FieldModel::MeanVector(const Eigen::VectorXd& coefficients) const {
  const Eigen::VectorXd vector = Vector(coefficients);
  return blur_.size() == 0 ? vector : code_->MeanOfImages(vector, blur_);
}

double FieldModel::Value(const Eigen::VectorXd& vector) const {
  if (objective_.metric) return objective_.metric(code_->Decode(vector));
  return objective_.sad_scale * code_->Sad(vector);
}

void FieldModel::ForEachPoint(Eigen::Index count, double num_images,
                              const std::function<void(Eigen::Index)>& body) const {
  base::ParallelFor({.num_items = count, .item_work = num_images * ImageWork()}, body);
}

double FieldModel::ImageWork() const {
  constexpr double kElementWork = 30;
  const Eigen::Index size = objective_.metric
                                ? static_cast<Eigen::Index>(objective_.width) * objective_.height
                                : modes_.modes().basis.rows();
  return kElementWork * static_cast<double>(size);
}

double FieldModel::PredictionWork() const {
  const auto size = static_cast<double>(residuals_.rows());
  return num_modes() * size * (size / 2 + 40) + kNumDraws * ImageWork();
}

double FieldModel::Expected(const At& at, const Eigen::VectorXd& noise) const {
  if (objective_.metric) return ValuesOfDraws(at).mean();
  Eigen::VectorXd variance = modes_.modes().basis.cwiseAbs2() * at.variance;
  if (noise.size() > 0) variance += noise;
  // With noise it is one evaluation that is expected, not a mean of them.
  const Eigen::VectorXd vector = noise.size() > 0 ? Vector(at.mean) : MeanVector(at.mean);
  return objective_.sad_scale * code_->ExpectedSad(vector, variance);
}

Eigen::VectorXd FieldModel::ValuesOfDraws(const At& at) const {
  const Eigen::VectorXd sd = at.variance.cwiseSqrt();
  Eigen::VectorXd values(kNumDraws);
  for (Eigen::Index i = 0; i < kNumDraws; ++i) {
    values[i] = Value(MeanVector(at.mean + sd.cwiseProduct(normals_.row(i).transpose())));
  }
  return values;
}

surrogate::Predictions FieldModel::ReconstructionError(const Eigen::MatrixXd& points) const {
  if (reconstruction_) return reconstruction_->PredictAll(points);
  return {.mean = Eigen::VectorXd::Zero(points.rows()),
          .variance = Eigen::VectorXd::Zero(points.rows())};
}

double FieldModel::Mean(const Eigen::VectorXd& x) const { return Means(x.transpose())[0]; }

Eigen::VectorXd FieldModel::Means(const Eigen::MatrixXd& points) const {
  const surrogate::ModeMoments modes = modes_.Predict(points);
  Eigen::VectorXd means = ReconstructionError(points).mean;
  ForEachPoint(points.rows(), 6, [&](Eigen::Index i) {
    means[i] += Expected({modes.mean.row(i), modes.variance.row(i)}, {});
  });
  return means;
}

Moments FieldModel::Predict(const Eigen::MatrixXd& points) const {
  const surrogate::ModeMoments modes = modes_.Predict(points);
  const surrogate::Predictions error = ReconstructionError(points);
  Moments moments{.mean = error.mean, .sd = Eigen::VectorXd(points.rows())};
  ForEachPoint(points.rows(), 6 + kNumDraws, [&](Eigen::Index i) {
    const At at{modes.mean.row(i), modes.variance.row(i)};
    const double sd_of_draws = StandardDeviation(ValuesOfDraws(at));
    moments.mean[i] += Expected(at, {});
    moments.sd[i] = std::sqrt(sd_of_draws * sd_of_draws + error.variance[i]);
  });
  return moments;
}

Sensitivities FieldModel::SensitivitiesAt(const Eigen::MatrixXd& points) const {
  const surrogate::ModeMoments modes = modes_.Predict(points);
  Sensitivities result{.slope = Eigen::MatrixXd(points.rows(), num_modes()),
                       .curvature = Eigen::MatrixXd(points.rows(), num_modes())};
  ForEachPoint(points.rows(), 6 + 12.0 * num_modes(), [&](Eigen::Index i) {
    At at{modes.mean.row(i), modes.variance.row(i)};
    const double here = Expected(at, {});
    for (Eigen::Index k = 0; k < num_modes(); ++k) {
      const double middle = at.mean[k];
      const double step = std::sqrt(std::max(at.variance[k], std::numeric_limits<double>::min()));
      at.mean[k] = middle + step;
      const double above = Expected(at, {});
      at.mean[k] = middle - step;
      const double below = Expected(at, {});
      result.slope(i, k) = (above - below) / (2 * step);
      result.curvature(i, k) = (above - 2 * here + below) / (step * step);
      at.mean[k] = middle;
    }
  });
  return result;
}

double FieldModel::LogImprovementOfDraws(const Eigen::VectorXd& draws, double incumbent) const {
  const Eigen::ArrayXd gain = incumbent - draws.array();
  const double mean_gain = gain.max(0).mean();
  if (mean_gain > 0) return std::log(mean_gain);
  return kHopeless / 2 + gain.maxCoeff() / std::max(std::abs(incumbent), 1e-300);
}

// What Σ |Δ| over the columns can be at most for draws within four standard deviations: no image
// differs from the mean one by more.
double FieldModel::Reach(const At& at) const {
  const Eigen::VectorXd sd = (modes_.modes().basis.cwiseAbs2() * at.variance).cwiseSqrt();
  return 4 * objective_.sad_scale * sd.sum();
}

Eigen::VectorXd FieldModel::LogImprovement(const Eigen::MatrixXd& points, double incumbent,
                                           double noise) const {
  const surrogate::ModeMoments modes = modes_.Predict(points);
  const surrogate::Predictions error = ReconstructionError(points);
  Eigen::VectorXd result(points.rows());
  ForEachPoint(points.rows(), 1 + kNumDraws, [&](Eigen::Index i) {
    result[i] = LogImprovementAt(
        {modes.mean.row(i), modes.variance.row(i)},
        {.value = incumbent - error.mean[i], .noise = noise, .error_variance = error.variance[i]});
  });
  return result;
}

double FieldModel::LogImprovementAt(const At& at, const Goal& goal) const {
  const double reach = objective_.metric ? std::numeric_limits<double>::infinity() : Reach(at);
  const double excess = objective_.metric ? 0 : Value(MeanVector(at.mean)) - goal.value;
  if (excess > reach) return kHopeless - excess / std::max(reach, 1e-300);
  const Eigen::VectorXd draws = ValuesOfDraws(at);
  if (!(goal.noise > 0)) return LogImprovementOfDraws(draws, goal.value);
  const double sd_of_draws = StandardDeviation(draws);
  const double sd = std::sqrt(sd_of_draws * sd_of_draws + goal.error_variance);
  return AugmentedLogExpectedImprovement(draws.mean(), sd, goal.value, goal.noise).value;
}

FieldModel::At FieldModel::Nearest(const surrogate::ModeMoments& modes) const {
  Eigen::Index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < modes.mean.rows(); ++i) {
    const double gap = (target_ - MeanVector(modes.mean.row(i).transpose())).squaredNorm();
    if (gap >= least) continue;
    least = gap;
    nearest = i;
  }
  return {modes.mean.row(nearest), modes.variance.row(nearest)};
}

// The target's heaps are as noisy as evaluations. Where even the best image misses the target by
// more than that, as one of another powder than any simulated may, the errors are larger by as
// much.
Eigen::MatrixXd FieldModel::TargetErrors(const At& nearest, int num_draws,
                                         base::Random random) const {
  const Eigen::MatrixXd& basis = modes_.modes().basis;
  const double share = 1.0 / objective_.num_target_heaps;
  const double expected =
      (basis.cwiseAbs2() * nearest.variance + share * modes_.ElementNoise()).sum();
  const double missed = (target_ - MeanVector(nearest.mean)).squaredNorm() / expected;
  const double scale = kInflation * std::sqrt(std::max(1.0, missed) * share);
  const Eigen::VectorXd sd = scale * modes_.ModeNoise().cwiseSqrt();
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
Eigen::MatrixXd FieldModel::Draw(const Eigen::MatrixXd& points, int num_draws,
                                 base::Random random) const {
  std::vector<Eigen::MatrixXd> modes = modes_.Draw(points, num_draws, random.Next());
  Eigen::MatrixXd draws = reconstruction_ ? reconstruction_->Draw(points, num_draws, random)
                                          : Eigen::MatrixXd::Zero(num_draws, points.rows());
  const bool exact = objective_.num_target_heaps == 0 || target_.size() == 0;
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(exact ? 0 : num_draws, target_.size());
  if (!exact) {
    const surrogate::ModeMoments at = modes_.Predict(points);
    errors = TargetErrors(Nearest(at), num_draws,
                          base::Random(random.Next(), base::Stream("target errors")));
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const Eigen::RowVectorXd mean = at.mean.col(column).transpose();
      modes[k] = (kInflation * (modes[k].rowwise() - mean)).rowwise() + mean;
    }
  }
  ForEachPoint(draws.rows(), static_cast<double>(draws.cols()), [&](Eigen::Index d) {
    Eigen::VectorXd coefficients(static_cast<Eigen::Index>(modes.size()));
    for (Eigen::Index i = 0; i < draws.cols(); ++i) {
      for (std::size_t k = 0; k < modes.size(); ++k) {
        coefficients[static_cast<Eigen::Index>(k)] = modes[k](d, i);
      }
      Eigen::VectorXd vector = MeanVector(coefficients);
      if (!exact) vector -= errors.row(d).transpose();
      draws(d, i) += Value(vector);
    }
  });
  return draws;
}

double FieldModel::NoiseSd(const Eigen::VectorXd& x) const {
  const surrogate::ModeMoments modes = modes_.Predict(x.transpose());
  const double error = reconstruction_ ? reconstruction_->noise_variance() : 0;
  const double sd_of_draws =
      StandardDeviation(ValuesOfDraws({modes.mean.row(0), modes_.ModeNoise()}));
  return std::sqrt(sd_of_draws * sd_of_draws + error);
}

Eigen::VectorXd FieldModel::LeaveOneOut() const {
  const surrogate::ModeMoments modes = modes_.LeaveOneOut();
  Eigen::VectorXd values = reconstruction_ ? reconstruction_->LeaveOneOut().mean
                                           : Eigen::VectorXd::Zero(modes.mean.rows());
  const Eigen::VectorXd discarded = modes_.modes().discarded;
  ForEachPoint(values.size(), 6, [&](Eigen::Index i) {
    values[i] += Expected({modes.mean.row(i), modes.variance.row(i)}, discarded);
  });
  return values;
}

void FieldModel::AddFantasy(const Eigen::VectorXd& x) {
  modes_.Add(x, Vector(modes_.Predict(x.transpose()).mean.row(0).transpose()));
  if (reconstruction_) reconstruction_->AddFantasy(x);
}

}  // namespace talus::optimizer
