#include "optimizer/posterior/experiment_model.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "optimizer/space/distinct_points.h"

namespace talus::optimizer {
namespace {

// A compressed number's median and sd as the number itself has them.
Moments InOwnUnit(const ScalarTarget& target, const surrogate::Predictions& compressed) {
  const double scale = CompressionScale(target);
  return {.mean = scale * compressed.mean.array().sinh(),
          .sd = scale * compressed.mean.array().cosh() * compressed.variance.array().sqrt()};
}

// Distinct sets at a scale factor: what is repeated says nothing of another place.
double NumSetsAt(const OutputData& data, int level) {
  DistinctPoints sets;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    if (data.level[i] == level) sets.Add(data.points[i]);
  }
  return sets.size();
}

constexpr double kOfMany = 1.2;  // SurrogateCaution of many evaluations

// The outputs tell of the same few parameters, and a surrogate that is unsure of one is unsure of
// all: counted one by one, a set of which little is known would pass for unlikely. The share by
// which truths are likeliest (bench/RECORD.md).
constexpr double kUnsure = 0.75;

}  // namespace

double SurrogateCaution(double num_finest) {
  constexpr double kFew = 15;  // evaluations of which the variance counts twice
  return kOfMany * std::sqrt(1 + kFew / std::max(1.0, num_finest));
}

void ExperimentModel::TakeForFinest(double times) {
  constexpr double kMostBeyond = 6;  // bench/optimizers/RECORD.md
  const double num = times * num_finest_;
  caution_ = SurrogateCaution(setup_.levels->is_extrapolated() ? std::min(num, kMostBeyond) : num);
}

ExperimentModel::ExperimentModel(const Setup& setup, const OutputData& data,
                                 const OutputState* frozen)
    : setup_(setup),
      outputs_({.levels = *setup.levels, .scalars = setup.target->scalars}, data, frozen) {
  num_finest_ = NumSetsAt(data, setup_.levels->finest());
  TakeForFinest(1);
  measured_ = Eigen::VectorXd::Zero(num_outputs());
  error_ = Eigen::VectorXd::Ones(num_outputs());
  unmatched_ = Eigen::VectorXd::Ones(num_outputs());
  if (has_image()) MeasureImages();
  MeasureScalars();
  SetModelError({.value = setup.model_error});
}

Eigen::VectorXd ExperimentModel::OpenWith(double model_error) const {
  return error_ + model_error * model_error * unmatched_;
}

void ExperimentModel::SetModelError(const ModelError& model_error) {
  model_error_ = model_error;
  open_ = OpenWith(model_error.value);
}

// The experiment's heaps vary as simulated ones do along each mode, times one factor that its runs
// tell: a few runs say little of each mode by itself.
void ExperimentModel::MeasureImages() {
  constexpr double kPriorRuns = 8;  // evidence, in squared deviations, for a factor of 1
  const ExperimentTarget& target = *setup_.target;
  const surrogate::PrincipalModes& modes = outputs_.modes();
  const Eigen::Index num_modes = outputs_.num_modes();
  const Eigen::VectorXd noise = outputs_.ModeNoise();
  const auto num_runs = static_cast<double>(target.runs.size());
  double heaps = std::max(1, target.image.num_target_heaps);
  double factor = 1;
  if (target.runs.size() < 2) {
    // The mean image of several heaps has wider edges than each of them.
    const Eigen::VectorXd among_heaps = (1 - 1 / heaps) * outputs_.ElementNoise();
    measured_.head(num_modes) = modes.Coefficients(
        setup_.code->OneOfMean(setup_.code->Encode(target.image.target), among_heaps));
  } else {
    Eigen::MatrixXd runs(target.runs.size(), num_modes);
    for (std::size_t r = 0; r < target.runs.size(); ++r) {
      runs.row(static_cast<Eigen::Index>(r)) =
          modes.Coefficients(setup_.code->Encode(target.runs[r]));
    }
    const Eigen::RowVectorXd mean = runs.colwise().mean();
    measured_.head(num_modes) = mean.transpose();
    const Eigen::VectorXd squares = (runs.rowwise() - mean).colwise().squaredNorm().transpose();
    const double deviations = squares.cwiseQuotient(noise).sum();
    const double freedom = static_cast<double>(num_modes) * (num_runs - 1);
    factor = (deviations + kPriorRuns) / (freedom + kPriorRuns);
    heaps = num_runs;
  }
  // Runs that happen to agree do not make heaps reproducible.
  constexpr double kLeastFactor = 0.25;
  unmatched_.head(num_modes) = std::max(kLeastFactor, factor) * noise;
  error_.head(num_modes) = unmatched_.head(num_modes) / heaps;
  // A share 1 - 1/n of the variance of n heaps lies among them and 1/n is their mean's.
  const Eigen::VectorXd element =
      outputs_.ElementNoise() + modes.basis.cwiseAbs2() * (unmatched_.head(num_modes) - noise);
  objective_.emplace(setup_.code, target.image, modes, (1 - 1 / heaps) * element);
}

void ExperimentModel::MeasureScalars() {
  const Eigen::Index num_modes = outputs_.num_modes();
  const auto& scalars = setup_.target->scalars;
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    const Eigen::Index k = num_modes + static_cast<Eigen::Index>(s);
    const double error = CompressedError(scalars[s]);
    measured_[k] = Compress(scalars[s], scalars[s].value);
    error_[k] = error * error;
    unmatched_[k] = outputs_.TargetNoise(k);
  }
}

OutputMoments ExperimentModel::Outputs(const Eigen::MatrixXd& points) const {
  OutputMoments outputs{.mean = Eigen::MatrixXd(points.rows(), num_outputs()),
                        .variance = Eigen::MatrixXd(points.rows(), num_outputs())};
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const surrogate::Predictions all = PredictOutput(k, points);
    outputs.mean.col(k) = all.mean;
    outputs.variance.col(k) = all.variance;
  }
  return outputs;
}

surrogate::Predictions ExperimentModel::PredictOutput(Eigen::Index output,
                                                      const Eigen::MatrixXd& points) const {
  surrogate::Predictions at = outputs_.output(output).PredictAll(points);
  if (output < outputs_.num_modes()) return at;
  const ScalarTarget& scalar =
      setup_.target->scalars[static_cast<std::size_t>(output - outputs_.num_modes())];
  at.mean = at.mean.cwiseMax(Compress(scalar, scalar.low)).cwiseMin(Compress(scalar, scalar.high));
  return at;
}

std::vector<Eigen::MatrixXd> ExperimentModel::ErrorDraws(const Eigen::MatrixXd& points,
                                                         int num_draws, std::uint64_t seed) const {
  std::vector<Eigen::MatrixXd> errors;
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const surrogate::GaussianProcess& output = outputs_.output(k);
    const base::Random random(seed, base::Stream("surrogate's errors"),
                              static_cast<std::uint64_t>(k));
    errors.push_back(output.Draw(points, num_draws, random).rowwise() -
                     output.PredictAll(points).mean.transpose());
  }
  return errors;
}

OutputMisfit ExperimentModel::MisfitOf(const OutputMoments& outputs, double caution,
                                       const Eigen::VectorXd& open) const {
  const Eigen::Index num_points = outputs.mean.rows();
  OutputMisfit misfit{.residual = Eigen::MatrixXd(num_points, num_outputs()),
                      .log_sd = Eigen::VectorXd::Zero(num_points),
                      .share = Eigen::VectorXd::Zero(num_points)};
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const auto variance = outputs.variance.col(k).array();
    const Eigen::ArrayXd cautious = caution * caution * variance + open[k];
    misfit.share.array() += (1 - open[k] / cautious) / num_outputs();
    misfit.residual.col(k) = (measured_[k] - outputs.mean.col(k).array()) / cautious.sqrt();
    misfit.log_sd.array() += 0.5 * (std::log(open[k]) + kUnsure * (variance / open[k]).log1p());
  }
  return misfit;
}

OutputPredictions ExperimentModel::Predict(const Eigen::MatrixXd& points) const {
  const OutputMoments outputs = Outputs(points);
  OutputPredictions predictions{.mean = outputs.mean,
                                .variance = caution_ * caution_ * outputs.variance,
                                .measured = error_,
                                .model = open_ - error_,
                                .single = Eigen::VectorXd(num_outputs())};
  for (Eigen::Index k = 0; k < num_outputs(); ++k) predictions.single[k] = outputs_.TargetNoise(k);
  return predictions;
}

double ExperimentModel::Misfit(const Eigen::VectorXd& x) const {
  const Eigen::RowVectorXd residual =
      MisfitOf(Outputs(x.transpose()), caution_, OpenWith(setup_.model_error)).residual.row(0);
  const Eigen::Index num_modes = outputs_.num_modes();
  double most = 0;
  if (num_modes > 0) most = std::sqrt(residual.head(num_modes).array().square().mean());
  for (Eigen::Index k = num_modes; k < residual.size(); ++k) {
    most = std::max(most, std::abs(residual[k]));
  }
  return most;
}

Eigen::VectorXd ExperimentModel::SquaredMisfit(const Eigen::MatrixXd& points) const {
  return MisfitOf(Outputs(points), caution_ / kOfMany, OpenWith(setup_.model_error))
      .residual.rowwise()
      .squaredNorm();
}

Eigen::MatrixXd ExperimentModel::Gains(const Eigen::MatrixXd& draws, const Eigen::MatrixXd& sites,
                                       const std::function<void(const Narrowed&)>& show) const {
  Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(sites.rows(), setup_.levels->size());
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const surrogate::GaussianProcess& output = outputs_.output(k);
    const surrogate::AnchorPoints anchors = output.Anchor(draws);
    const Eigen::ArrayXd before = anchors.variance.array() + open_[k];
    for (int level = 0; level < setup_.levels->size(); ++level) {
      const double noise = output.noise_variance(level);
      const surrogate::Covariances at =
          output.PosteriorCovariances(anchors, sites, setup_.levels->growth(level));
      for (Eigen::Index i = 0; i < sites.rows(); ++i) {
        const Eigen::ArrayXd taken = at.between.col(i).array().square() / (at.variance[i] + noise);
        const Eigen::ArrayXd after = (anchors.variance.array() - taken).max(0.0) + open_[k];
        gains(i, level) += 0.5 * (before / after).log().mean();
        show({.output = k, .site = i, .level = level, .before = before, .after = after});
      }
    }
  }
  return gains;
}

Eigen::VectorXd ExperimentModel::GainOfAll(const Eigen::MatrixXd& points) const {
  Eigen::VectorXd gain = Eigen::VectorXd::Zero(points.rows());
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const surrogate::Predictions all = outputs_.output(k).PredictAll(points);
    gain.array() += 0.5 * (1 + all.variance.array() / open_[k]).log();
  }
  return gain;
}

Moments ExperimentModel::Objective(const Eigen::MatrixXd& points) const {
  const ModeMoments modes = outputs_.PredictModes(points);
  Moments moments{.mean = Eigen::VectorXd(points.rows()), .sd = Eigen::VectorXd(points.rows())};
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Moment at = objective_->MomentsAt({modes.mean.row(i), modes.variance.row(i)});
    moments.mean[i] = at.mean;
    moments.sd[i] = at.sd;
  }
  return moments;
}

Eigen::VectorXd ExperimentModel::OutlinedObjective(const Eigen::MatrixXd& points) const {
  const ModeMoments modes = outputs_.PredictModes(points);
  Eigen::VectorXd expected(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    expected[i] = objective_->Outlined({modes.mean.row(i), modes.variance.row(i)});
  }
  return expected;
}

double ExperimentModel::ObjectiveNoise(const Eigen::VectorXd& x) const {
  return objective_->SdOfDraws(
      {outputs_.PredictModes(x.transpose()).mean.row(0), outputs_.ModeNoise()});
}

ExperimentStanding ExperimentModel::StandingAt(const Eigen::VectorXd& x) const {
  ExperimentStanding standing{.name = setup_.target->name,
                              .caution = caution_,
                              .model_error = model_error_.value,
                              .model_error_told = model_error_.told};
  if (has_image()) {
    const Moments moments = Objective(x.transpose());
    standing.predicted = moments.mean[0];
    standing.predicted_sd = moments.sd[0];
  }
  for (const Moments& number : Scalars(x.transpose())) {
    standing.numbers.push_back({.predicted = number.mean[0], .predicted_sd = number.sd[0]});
  }
  return standing;
}

std::vector<Moments> ExperimentModel::Scalars(const Eigen::MatrixXd& points) const {
  const auto& scalars = setup_.target->scalars;
  std::vector<Moments> all;
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    const auto output = outputs_.num_modes() + static_cast<Eigen::Index>(s);
    const surrogate::Predictions at = PredictOutput(output, points);
    all.push_back(InOwnUnit(scalars[s], at));
  }
  return all;
}

std::vector<double> ExperimentModel::ScalarNoise(const Eigen::VectorXd& x) const {
  std::vector<double> noise;
  for (const ScalarTarget& scalar : setup_.target->scalars) {
    const auto output = outputs_.num_modes() + static_cast<Eigen::Index>(noise.size());
    surrogate::Predictions at = PredictOutput(output, x.transpose());
    at.variance.setConstant(outputs_.TargetNoise(output));
    noise.push_back(InOwnUnit(scalar, at).sd[0]);
  }
  return noise;
}

Eigen::VectorXd ExperimentModel::OutputsOf(std::span<const float> field,
                                           const std::vector<double>& scalars) const {
  Eigen::VectorXd outputs = Eigen::VectorXd::Constant(num_outputs(), base::kNotKnown);
  const Eigen::Index num_modes = outputs_.num_modes();
  if (has_image()) {
    outputs.head(num_modes) = outputs_.modes().Coefficients(setup_.code->Encode(field));
  }
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    outputs[num_modes + static_cast<Eigen::Index>(s)] =
        Compress(setup_.target->scalars[s], scalars[s]);
  }
  return outputs;
}

Eigen::VectorXd ExperimentModel::NoiseAt(double scale_factor) const {
  const int level = setup_.levels->LevelOf(scale_factor);
  Eigen::VectorXd variance(num_outputs());
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    variance[k] = outputs_.output(k).noise_variance(level);
  }
  return variance;
}

std::vector<float> ExperimentModel::MeanImage(const Eigen::VectorXd& x) const {
  return setup_.code->Decode(
      objective_->MeanImage(outputs_.PredictModes(x.transpose()).mean.row(0).transpose()));
}

}  // namespace talus::optimizer
