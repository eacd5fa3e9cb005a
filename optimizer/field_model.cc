#include "optimizer/field_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "optimizer/acquisition.h"

namespace talus::optimizer {
namespace {

constexpr int kNumDraws = 16;  // half of them the mirror images of the others
// Without scatter every mode that is more than rounding is signal; with it the weak ones are noise.
constexpr int kModesIfNoisy = 6;
constexpr int kModesIfDeterministic = 12;
// A code that loses less than this share of the spread of the objective needs no process for it.
constexpr double kSmallLoss = 1e-3;
// Every evaluation brings as many numbers as there are modes, so they may bend more than one number
// could tell.
constexpr double kBendSd = 2;
constexpr double kHopeless = -1e6;  // below every logarithm of an improvement

surrogate::ModeOptions OptionsOf(const FieldModelOptions& options, const FieldState* frozen) {
  surrogate::ModeOptions modes;
  modes.max_modes = options.deterministic ? kModesIfDeterministic : kModesIfNoisy;
  modes.process.trend = surrogate::Trend::kQuadratic;
  modes.process.deterministic = options.deterministic;
  modes.process.seed = options.seed;
  modes.process.bend_inputs = !options.deterministic;
  modes.process.priors.bend_sd = kBendSd;
  if (frozen != nullptr) modes.frozen = frozen->modes;
  return modes;
}

double Spread(const Eigen::VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

std::optional<surrogate::GaussianProcess> FitLoss(const CodedFields& data,
                                                  const FieldModelOptions& options,
                                                  const FieldState* frozen) {
  surrogate::GaussianProcessOptions process{.deterministic = options.deterministic,
                                            .seed = options.seed};
  if (frozen != nullptr) {
    if (!frozen->loss) return std::nullopt;
    process.frozen = frozen->loss;
  } else if (data.losses.cwiseAbs().maxCoeff() <= kSmallLoss * Spread(data.values)) {
    return std::nullopt;
  }
  return surrogate::GaussianProcess::Fit(data.points, data.losses, process);
}

Eigen::MatrixXd MirroredNormals(Eigen::Index num_modes, std::uint64_t seed) {
  base::Random random(seed, base::Stream("field draws"));
  Eigen::MatrixXd normals(kNumDraws, num_modes);
  for (Eigen::Index i = 0; i < kNumDraws / 2; ++i) {
    for (Eigen::Index k = 0; k < num_modes; ++k) normals(i, k) = random.Normal();
  }
  normals.bottomRows(kNumDraws / 2) = -normals.topRows(kNumDraws / 2);
  return normals;
}

}  // namespace

FieldModel::FieldModel(std::shared_ptr<const surrogate::FieldCode> code,
                       const FieldObjective& objective, const CodedFields& data,
                       const FieldModelOptions& options, const FieldState* frozen)
    : code_(std::move(code)),
      objective_(objective),
      modes_(surrogate::ModeProcess::Fit(data.points, data.vectors, OptionsOf(options, frozen))),
      loss_(FitLoss(data, options, frozen)),
      normals_(MirroredNormals(modes_.modes().basis.cols(), options.seed)) {}

int FieldModel::num_parameters() const { return modes_.num_parameters(); }

FieldState FieldModel::state() const {
  return {.modes = modes_.state(), .loss = loss_ ? std::optional(loss_->state()) : std::nullopt};
}

Eigen::VectorXd FieldModel::Vector(const Eigen::VectorXd& coefficients) const {
  return modes_.modes().mean + modes_.modes().basis * coefficients;
}

double FieldModel::Value(const Eigen::VectorXd& vector) const {
  if (objective_.metric) return objective_.metric(code_->Decode(vector));
  return objective_.sad_scale * code_->Sad(vector);
}

double FieldModel::Expected(const At& at, const Eigen::VectorXd& scatter) const {
  if (objective_.metric) return ValuesOfDraws(at).mean();
  Eigen::VectorXd variance = modes_.modes().basis.cwiseAbs2() * at.variance;
  if (scatter.size() > 0) variance += scatter;
  return objective_.sad_scale * code_->ExpectedSad(Vector(at.mean), variance);
}

Eigen::VectorXd FieldModel::ValuesOfDraws(const At& at) const {
  const Eigen::VectorXd sd = at.variance.cwiseSqrt();
  Eigen::VectorXd values(kNumDraws);
  for (Eigen::Index i = 0; i < kNumDraws; ++i) {
    values[i] = Value(Vector(at.mean + sd.cwiseProduct(normals_.row(i).transpose())));
  }
  return values;
}

surrogate::Predictions FieldModel::Loss(const Eigen::MatrixXd& points) const {
  if (loss_) return loss_->PredictAll(points);
  return {.mean = Eigen::VectorXd::Zero(points.rows()),
          .variance = Eigen::VectorXd::Zero(points.rows())};
}

double FieldModel::Mean(const Eigen::VectorXd& x) const {
  const surrogate::ModeMoments modes = modes_.Predict(x.transpose());
  return Expected({modes.mean.row(0), modes.variance.row(0)}, {}) + Loss(x.transpose()).mean[0];
}

Moments FieldModel::Predict(const Eigen::MatrixXd& points) const {
  const surrogate::ModeMoments modes = modes_.Predict(points);
  const surrogate::Predictions loss = Loss(points);
  Moments moments{.mean = loss.mean, .sd = Eigen::VectorXd(points.rows())};
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const At at{modes.mean.row(i), modes.variance.row(i)};
    const double spread = Spread(ValuesOfDraws(at));
    moments.mean[i] += Expected(at, {});
    moments.sd[i] = std::sqrt(spread * spread + loss.variance[i]);
  }
  return moments;
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
  const surrogate::Predictions loss = Loss(points);
  Eigen::VectorXd result(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const At at{modes.mean.row(i), modes.variance.row(i)};
    const double goal = incumbent - loss.mean[i];
    const double reach = objective_.metric ? std::numeric_limits<double>::infinity() : Reach(at);
    const double excess = objective_.metric ? 0 : Value(Vector(at.mean)) - goal;
    if (excess > reach) {
      result[i] = kHopeless - excess / std::max(reach, 1e-300);
      continue;
    }
    const Eigen::VectorXd draws = ValuesOfDraws(at);
    if (noise > 0) {
      const double spread = Spread(draws);
      const double sd = std::sqrt(spread * spread + loss.variance[i]);
      result[i] = AugmentedLogExpectedImprovement(draws.mean(), sd, goal, noise).value;
    } else {
      result[i] = LogImprovementOfDraws(draws, goal);
    }
  }
  return result;
}

Eigen::MatrixXd FieldModel::Draw(const Eigen::MatrixXd& points, int num_draws,
                                 base::Random random) const {
  const std::vector<Eigen::MatrixXd> modes = modes_.Draw(points, num_draws, random.Next());
  Eigen::MatrixXd draws = loss_ ? loss_->Draw(points, num_draws, random)
                                : Eigen::MatrixXd::Zero(num_draws, points.rows());
  Eigen::VectorXd coefficients(static_cast<Eigen::Index>(modes.size()));
  for (Eigen::Index d = 0; d < draws.rows(); ++d) {
    for (Eigen::Index i = 0; i < draws.cols(); ++i) {
      for (std::size_t k = 0; k < modes.size(); ++k) {
        coefficients[static_cast<Eigen::Index>(k)] = modes[k](d, i);
      }
      draws(d, i) += Value(Vector(coefficients));
    }
  }
  return draws;
}

double FieldModel::NoiseSd(const Eigen::VectorXd& x) const {
  const surrogate::ModeMoments modes = modes_.Predict(x.transpose());
  const double loss = loss_ ? loss_->noise_variance() : 0;
  const double spread = Spread(ValuesOfDraws({modes.mean.row(0), modes_.ModeNoise()}));
  return std::sqrt(spread * spread + loss);
}

Eigen::VectorXd FieldModel::LeaveOneOut() const {
  const surrogate::ModeMoments modes = modes_.LeaveOneOut();
  Eigen::VectorXd values =
      loss_ ? loss_->LeaveOneOut().mean : Eigen::VectorXd::Zero(modes.mean.rows());
  const Eigen::VectorXd discarded = modes_.modes().discarded;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] += Expected({modes.mean.row(i), modes.variance.row(i)}, discarded);
  }
  return values;
}

void FieldModel::Believe(const Eigen::VectorXd& x) {
  modes_.Add(x, Vector(modes_.Predict(x.transpose()).mean.row(0).transpose()));
  if (loss_) loss_->Add(x, loss_->Predict(x).mean);
}

}  // namespace talus::optimizer
