#include "optimizer/fidelity/experiment_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "optimizer/fidelity/output_noise.h"
#include "optimizer/models/mirrored_normals.h"
#include "surrogate/standard_deviation.h"

namespace talus::optimizer {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostModes = 8;
constexpr int kNumDraws = 16;  // of an objective

// Values far above the target are compressed, so that a mass that spans decades stays smooth where
// it matters. Linear up to the target.
double Compress(const ScalarTarget& target, double value) {
  const double scale = std::abs(target.value) + target.standard_error;
  return std::asinh(value / scale);
}

double CompressionSlope(const ScalarTarget& target) {
  const double scale = std::abs(target.value) + target.standard_error;
  return 1 / std::sqrt(scale * scale + target.value * target.value);
}

// A heap of a few coarse grains says less of the image than one of many fine ones.
Eigen::VectorXd ImageWeights(const Levels& levels, const ExperimentData& data) {
  Eigen::VectorXd weights(data.size());
  for (int i = 0; i < data.size(); ++i) {
    weights[i] = std::pow(levels.NoiseAtTarget(data.level[static_cast<std::size_t>(i)]), 2);
  }
  return weights;
}

}  // namespace

double SurrogateCaution(int num_finest) {
  constexpr double kOfMany = 2;
  constexpr double kFew = 15;  // evaluations of which the variance counts twice
  return kOfMany * std::sqrt(1 + kFew / std::max(1, num_finest));
}

ExperimentModel::ExperimentModel(const Setup& setup, const ExperimentData& data,
                                 const ExperimentState* frozen)
    : setup_(setup), num_evaluations_(data.size()) {
  const auto num_finest = std::ranges::count(data.level, setup_.levels->finest());
  caution_ = SurrogateCaution(static_cast<int>(num_finest));
  if (has_image()) {
    if (frozen != nullptr) {
      modes_ = frozen->modes;
    } else {
      Eigen::MatrixXd vectors(data.size(), data.vectors.front().size());
      for (int i = 0; i < data.size(); ++i) {
        vectors.row(i) = data.vectors[static_cast<std::size_t>(i)];
      }
      modes_ = surrogate::FitModes(vectors, ImageWeights(*setup_.levels, data), kMostModes);
    }
  }
  FitOutputs(data, frozen);
  measured_ = Eigen::VectorXd::Zero(num_outputs());
  error_ = Eigen::VectorXd::Ones(num_outputs());
  open_ = Eigen::VectorXd::Ones(num_outputs());
  if (has_image()) MeasureImages();
  MeasureScalars();
}

Eigen::MatrixXd ExperimentModel::OutputValues(const ExperimentData& data) const {
  const Eigen::Index num_modes = modes_.basis.cols();
  const auto& scalars = setup_.target->scalars;
  Eigen::MatrixXd values(data.size(), num_modes + static_cast<Eigen::Index>(scalars.size()));
  for (int i = 0; i < data.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (num_modes > 0) values.row(i).head(num_modes) = modes_.Coefficients(data.vectors[k]);
    for (std::size_t s = 0; s < scalars.size(); ++s) {
      const double value = s < data.scalars[k].size() ? data.scalars[k][s] : kUndefined;
      values(i, num_modes + static_cast<Eigen::Index>(s)) = Compress(scalars[s], value);
    }
  }
  return values;
}

void ExperimentModel::FitOutputs(const ExperimentData& data, const ExperimentState* frozen) {
  const Eigen::MatrixXd values = OutputValues(data);
  const Eigen::Index num_modes = modes_.basis.cols();
  const double next_sd = modes_.next_sd / setup_.levels->NoiseAtTarget(0);
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      if (std::isfinite(values(i, k))) rows.push_back(i);
    }
    const auto count = static_cast<Eigen::Index>(rows.size());
    surrogate::FidelityData one{.points = Eigen::MatrixXd(data.points.front().size(), count),
                                .growth = Eigen::VectorXd(count),
                                .level = Eigen::VectorXi(count),
                                .values = values(rows, k)};
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
      one.points.col(i) = data.points[row];
      one.level[i] = data.level[row];
      one.growth[i] = setup_.levels->growth(data.level[row]);
    }
    surrogate::FidelityFitOptions options =
        k < num_modes ? NoiseOfMode(*setup_.levels, static_cast<int>(k), next_sd,
                                    surrogate::StandardDeviation(one.values))
                      : NoiseOfScalar(*setup_.levels);
    if (frozen != nullptr) options.frozen = frozen->outputs[static_cast<std::size_t>(k)];
    outputs_.push_back(surrogate::FidelityProcess::Fit(std::move(one), options));
    evaluations_.push_back(std::move(rows));
  }
}

ExperimentState ExperimentModel::state() const {
  ExperimentState state{.modes = modes_, .outputs = {}};
  for (const surrogate::FidelityProcess& output : outputs_) state.outputs.push_back(output.state());
  return state;
}

double ExperimentModel::TargetNoise(std::size_t output) const {
  const int finest = setup_.levels->finest();
  const double ratio = setup_.levels->NoiseAtTarget(finest);
  return ratio * ratio * outputs_[output].noise_variance(finest);
}

// The experiment's heaps vary as simulated ones do along each mode, times one factor that its runs
// tell: a few runs say little of each mode by itself.
void ExperimentModel::MeasureImages() {
  constexpr double kPriorRuns = 8;  // evidence, in squared deviations, for a factor of 1
  const ExperimentTarget& target = *setup_.target;
  const Eigen::Index num_modes = modes_.basis.cols();
  Eigen::VectorXd noise(num_modes);
  for (Eigen::Index k = 0; k < num_modes; ++k) noise[k] = TargetNoise(static_cast<std::size_t>(k));
  const auto num_runs = static_cast<double>(target.runs.size());
  double heaps = std::max(1, target.image.num_target_heaps);
  double factor = 1;
  if (target.runs.size() < 2) {
    // The mean image of several heaps has wider edges than each of them.
    const Eigen::VectorXd among_heaps =
        (1 - 1 / heaps) * (modes_.basis.cwiseAbs2() * noise + modes_.discarded);
    measured_.head(num_modes) = modes_.Coefficients(
        setup_.code->OneOfMean(setup_.code->Encode(target.image.target), among_heaps));
  } else {
    Eigen::MatrixXd runs(target.runs.size(), num_modes);
    for (std::size_t r = 0; r < target.runs.size(); ++r) {
      runs.row(static_cast<Eigen::Index>(r)) =
          modes_.Coefficients(setup_.code->Encode(target.runs[r]));
    }
    const Eigen::RowVectorXd mean = runs.colwise().mean();
    measured_.head(num_modes) = mean.transpose();
    const Eigen::VectorXd squares = (runs.rowwise() - mean).colwise().squaredNorm().transpose();
    const double deviations = squares.cwiseQuotient(noise).sum();
    const double freedom = static_cast<double>(num_modes) * (num_runs - 1);
    factor = (deviations + kPriorRuns) / (freedom + kPriorRuns);
    heaps = num_runs;
  }
  const double model_error = setup_.model_error * setup_.model_error;
  error_.head(num_modes) = std::max(0.25, factor) / heaps * noise;
  open_.head(num_modes) = (1 / heaps + model_error) * std::max(0.25, factor) * noise;
  Eigen::VectorXd element = modes_.basis.cwiseAbs2() * noise;
  // Of n heaps, a share 1 - 1/n of the variance lies among them and 1/n is their mean's.
  blur_ = (1 - 1 / heaps) * element;
}

void ExperimentModel::MeasureScalars() {
  const Eigen::Index num_modes = modes_.basis.cols();
  const auto& scalars = setup_.target->scalars;
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    const Eigen::Index k = num_modes + static_cast<Eigen::Index>(s);
    const double error = CompressionSlope(scalars[s]) * scalars[s].standard_error;
    const double model_error = setup_.model_error * setup_.model_error;
    measured_[k] = Compress(scalars[s], scalars[s].value);
    error_[k] = error * error;
    open_[k] = error * error + model_error * TargetNoise(static_cast<std::size_t>(k));
  }
}

OutputMisfit ExperimentModel::MisfitOf(const Eigen::MatrixXd& points, double caution) const {
  OutputMisfit misfit{.residual = Eigen::MatrixXd(points.rows(), num_outputs()),
                      .log_sd = Eigen::VectorXd::Zero(points.rows())};
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const surrogate::Predictions all = outputs_[static_cast<std::size_t>(k)].Predict(points, 0);
    const Eigen::ArrayXd cautious = caution * caution * all.variance.array() + open_[k];
    misfit.residual.col(k) = (measured_[k] - all.mean.array()) / cautious.sqrt();
    misfit.log_sd.array() += 0.5 * (all.variance.array() + open_[k]).log();
  }
  return misfit;
}

OutputPredictions ExperimentModel::Predict(const Eigen::MatrixXd& points) const {
  OutputPredictions predictions{.mean = Eigen::MatrixXd(points.rows(), num_outputs()),
                                .variance = Eigen::MatrixXd(points.rows(), num_outputs()),
                                .measured = error_,
                                .model = open_ - error_,
                                .single = Eigen::VectorXd(num_outputs())};
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const auto output = static_cast<std::size_t>(k);
    const surrogate::Predictions all = outputs_[output].Predict(points, 0);
    predictions.mean.col(k) = all.mean;
    predictions.variance.col(k) = caution_ * caution_ * all.variance;
    predictions.single[k] = TargetNoise(output);
  }
  return predictions;
}

double ExperimentModel::Misfit(const Eigen::VectorXd& x) const {
  const Eigen::RowVectorXd residual = MisfitOf(x.transpose()).residual.row(0);
  const Eigen::Index num_modes = modes_.basis.cols();
  double most = 0;
  if (num_modes > 0) most = std::sqrt(residual.head(num_modes).array().square().mean());
  for (Eigen::Index k = num_modes; k < residual.size(); ++k) {
    most = std::max(most, std::abs(residual[k]));
  }
  return most;
}

Eigen::VectorXd ExperimentModel::SquaredMisfit(const Eigen::MatrixXd& points) const {
  return MisfitOf(points, 1).residual.rowwise().squaredNorm();
}

Eigen::MatrixXd ExperimentModel::LeaveOneOut() const {
  Eigen::MatrixXd z = Eigen::MatrixXd::Constant(num_evaluations_, num_outputs(), kUndefined);
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const auto output = static_cast<std::size_t>(k);
    const surrogate::Predictions left_out = outputs_[output].LeaveOneOut();
    const Eigen::VectorXd values = outputs_[output].values();
    for (std::size_t i = 0; i < evaluations_[output].size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      z(evaluations_[output][i], k) =
          (values[row] - left_out.mean[row]) / std::sqrt(left_out.variance[row]);
    }
  }
  return z;
}

Eigen::MatrixXd ExperimentModel::Gains(const Eigen::MatrixXd& draws,
                                       const Eigen::MatrixXd& sites) const {
  Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(sites.rows(), setup_.levels->size());
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const surrogate::FidelityProcess& output = outputs_[static_cast<std::size_t>(k)];
    const auto watched = output.Watch(draws);
    const Eigen::ArrayXd before = watched.variance.array() + open_[k];
    for (int level = 0; level < setup_.levels->size(); ++level) {
      const double noise = output.noise_variance(level);
      for (Eigen::Index i = 0; i < sites.rows(); ++i) {
        const auto teaching =
            output.TeachingOf(watched, {.x = sites.row(i), .growth = setup_.levels->growth(level)});
        const Eigen::ArrayXd taken =
            teaching.covariance.array().square() / (teaching.site_variance + noise);
        const Eigen::ArrayXd after = (watched.variance.array() - taken).max(0.0) + open_[k];
        gains(i, level) += 0.5 * (before / after).log().mean();
      }
    }
  }
  return gains;
}

Eigen::VectorXd ExperimentModel::GainOfAll(const Eigen::MatrixXd& points) const {
  Eigen::VectorXd gain = Eigen::VectorXd::Zero(points.rows());
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const surrogate::Predictions all = outputs_[static_cast<std::size_t>(k)].Predict(points, 0);
    gain.array() += 0.5 * (1 + all.variance.array() / open_[k]).log();
  }
  return gain;
}

void ExperimentModel::AddFantasy(const Eigen::VectorXd& x, int level) {
  const double growth = setup_.levels->growth(level);
  for (surrogate::FidelityProcess& output : outputs_) {
    output.AddFantasy({.x = x, .growth = growth}, level);
  }
}

double ExperimentModel::ObjectiveOf(const Eigen::VectorXd& coefficients,
                                    const Eigen::VectorXd& variance) const {
  const FieldObjective& image = setup_.target->image;
  const Eigen::VectorXd vector =
      setup_.code->MeanOfImages(modes_.mean + modes_.basis * coefficients, blur_);
  if (image.metric) return image.metric(setup_.code->Decode(vector));
  return image.sad_scale * setup_.code->ExpectedSad(vector, modes_.basis.cwiseAbs2() * variance);
}

Eigen::VectorXd ExperimentModel::ObjectiveDraws(const Eigen::VectorXd& mean,
                                                const Eigen::VectorXd& sd) const {
  const Eigen::MatrixXd normals =
      MirroredNormals(kNumDraws, mean.size(), base::Random(1, base::Stream("objective draws")));
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(mean.size());
  Eigen::VectorXd draws(kNumDraws);
  for (Eigen::Index i = 0; i < kNumDraws; ++i) {
    draws[i] = ObjectiveOf(mean + sd.cwiseProduct(normals.row(i).transpose()), none);
  }
  return draws;
}

Moments ExperimentModel::Objective(const Eigen::MatrixXd& points) const {
  const Eigen::Index num_modes = modes_.basis.cols();
  Eigen::MatrixXd mean(points.rows(), num_modes);
  Eigen::MatrixXd variance(points.rows(), num_modes);
  for (Eigen::Index k = 0; k < num_modes; ++k) {
    const surrogate::Predictions all = outputs_[static_cast<std::size_t>(k)].Predict(points, 0);
    mean.col(k) = all.mean;
    variance.col(k) = all.variance;
  }
  Moments moments{.mean = Eigen::VectorXd(points.rows()), .sd = Eigen::VectorXd(points.rows())};
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    moments.mean[i] = ObjectiveOf(mean.row(i), variance.row(i));
    moments.sd[i] =
        surrogate::StandardDeviation(ObjectiveDraws(mean.row(i), variance.row(i).cwiseSqrt()));
  }
  return moments;
}

double ExperimentModel::ObjectiveNoise(const Eigen::VectorXd& x) const {
  const Eigen::Index num_modes = modes_.basis.cols();
  Eigen::VectorXd mean(num_modes);
  Eigen::VectorXd sd(num_modes);
  for (Eigen::Index k = 0; k < num_modes; ++k) {
    mean[k] = outputs_[static_cast<std::size_t>(k)].Predict(x.transpose(), 0).mean[0];
    sd[k] = std::sqrt(TargetNoise(static_cast<std::size_t>(k)));
  }
  return surrogate::StandardDeviation(ObjectiveDraws(mean, sd));
}

ExperimentStanding ExperimentModel::StandingAt(const Eigen::VectorXd& x) const {
  ExperimentStanding standing{
      .name = setup_.target->name, .predicted_objective = kUndefined, .predicted_sd = kUndefined};
  if (has_image()) {
    const Moments moments = Objective(x.transpose());
    standing.predicted_objective = moments.mean[0];
    standing.predicted_sd = moments.sd[0];
  }
  for (const Moments& number : Scalars(x.transpose())) {
    standing.numbers.push_back({.predicted = number.mean[0], .predicted_sd = number.sd[0]});
  }
  return standing;
}

std::vector<Moments> ExperimentModel::Scalars(const Eigen::MatrixXd& points) const {
  const auto& scalars = setup_.target->scalars;
  const std::size_t first = outputs_.size() - scalars.size();
  std::vector<Moments> all;
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    const surrogate::Predictions at = outputs_[first + s].Predict(points, 0);
    const double scale = std::abs(scalars[s].value) + scalars[s].standard_error;
    all.push_back({.mean = scale * at.mean.array().sinh(),
                   .sd = scale * at.mean.array().cosh() * at.variance.array().sqrt()});
  }
  return all;
}

std::vector<float> ExperimentModel::MeanImage(const Eigen::VectorXd& x) const {
  Eigen::VectorXd coefficients(modes_.basis.cols());
  for (Eigen::Index k = 0; k < coefficients.size(); ++k) {
    coefficients[k] = outputs_[static_cast<std::size_t>(k)].Predict(x.transpose(), 0).mean[0];
  }
  return setup_.code->Decode(
      setup_.code->MeanOfImages(modes_.mean + modes_.basis * coefficients, blur_));
}

}  // namespace talus::optimizer
