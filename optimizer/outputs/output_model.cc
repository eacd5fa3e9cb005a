#include "optimizer/outputs/output_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/not_known.h"
#include "base/parallel_for.h"
#include "optimizer/outputs/output_noise.h"
#include "surrogate/standard_deviation.h"

namespace talus::optimizer {
namespace {

constexpr int kMostModes = 8;
// Without noise every mode that is more than rounding is signal.
constexpr int kMostModesIfDeterministic = 12;

// A heap of a few coarse grains says less of the image than one of many fine ones.
Eigen::VectorXd ImageWeights(const Levels& levels, const OutputData& data) {
  Eigen::VectorXd weights(data.size());
  for (int i = 0; i < data.size(); ++i) {
    weights[i] = std::pow(levels.NoiseAtTarget(data.level[static_cast<std::size_t>(i)]), 2);
  }
  return weights;
}

surrogate::PrincipalModes FitImages(const OutputSetup& setup, const OutputData& data) {
  Eigen::MatrixXd vectors(data.size(), data.vectors.front().size());
  for (int i = 0; i < data.size(); ++i) vectors.row(i) = data.vectors[static_cast<std::size_t>(i)];
  return surrogate::FitModes(vectors, ImageWeights(setup.levels, data),
                             setup.deterministic ? kMostModesIfDeterministic : kMostModes);
}

surrogate::Evaluations RowsOf(const OutputData& data, const Levels& levels,
                              std::span<const Eigen::Index> rows) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  surrogate::Evaluations evaluations{.points = Eigen::MatrixXd(count, data.points.front().size()),
                                     .values = {},
                                     .growth = Eigen::VectorXd(count),
                                     .level = Eigen::VectorXi(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
    evaluations.points.row(i) = data.points[row];
    evaluations.level[i] = data.level[row];
    evaluations.growth[i] = levels.growth(data.level[row]);
  }
  return evaluations;
}

}  // namespace

// Nearly linear to ten errors from 0: a number that was measured at 0 is as many errors away as it
// says.
double CompressionScale(const ScalarTarget& target) {
  constexpr double kLinearErrors = 10;
  return std::max(std::abs(target.value) + target.standard_error,
                  kLinearErrors * target.standard_error);
}

double Compress(const ScalarTarget& target, double value) {
  return std::asinh(value / CompressionScale(target));
}

double CompressedError(const ScalarTarget& target) {
  const double scale = CompressionScale(target);
  return target.standard_error / std::sqrt(scale * scale + target.value * target.value);
}

OutputModel::OutputModel(OutputSetup setup, const OutputData& data, const OutputState* frozen)
    : setup_(std::move(setup)), num_evaluations_(data.size()) {
  if (!data.vectors.empty()) modes_ = frozen != nullptr ? frozen->modes : FitImages(setup_, data);
  FitProcesses(data, frozen);
}

Eigen::MatrixXd OutputModel::ValuesOf(const OutputData& data) const {
  const auto num_scalars = static_cast<Eigen::Index>(setup_.scalars.size());
  Eigen::MatrixXd values(data.size(), num_modes() + num_scalars);
  for (int i = 0; i < data.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (num_modes() > 0) values.row(i).head(num_modes()) = modes_.Coefficients(data.vectors[k]);
    for (Eigen::Index s = 0; s < num_scalars; ++s) {
      const auto place = static_cast<std::size_t>(s);
      const double value =
          place < data.scalars[k].size() ? data.scalars[k][place] : base::kNotKnown;
      values(i, num_modes() + s) = Compress(setup_.scalars[place], value);
    }
  }
  return values;
}

surrogate::GaussianProcessOptions OutputModel::OptionsFor(Eigen::Index output,
                                                          double spread) const {
  surrogate::GaussianProcessOptions options{.deterministic = setup_.deterministic,
                                            .seed = setup_.seed};
  if (setup_.deterministic) {  // a prior a level: as many noises as there are levels
    options.trend = surrogate::Trend::kQuadratic;
    options.priors.noise.resize(static_cast<std::size_t>(setup_.levels.size()),
                                options.priors.noise.front());
    return options;
  }
  const double next_sd = modes_.next_sd / setup_.levels.NoiseAtTarget(0);
  // Outputs that saturate are no parabolas: a quadratic trend is too sure of itself towards the
  // ends of the range.
  options.priors = surrogate::PriorsOfOutputs(
      output < num_modes() ? NoiseOfMode(setup_.levels, static_cast<int>(output), next_sd, spread)
                           : NoiseOfScalar(setup_.levels));
  if (output >= num_modes()) {
    options.usual_sd =
        CompressedError(setup_.scalars[static_cast<std::size_t>(output - num_modes())]);
  }
  options.warp_inputs = true;
  // One of many processes, which are fitted again and again as evaluations come in. Of several
  // scale factors every evaluation counts, since the finest are few.
  options.effort = {.num_starts = 1,
                    .num_searches = 2,
                    .max_evaluations = 50,
                    .relative_tolerance = 1e-6,
                    .may_thin = setup_.levels.size() == 1};
  return options;
}

void OutputModel::FitProcesses(const OutputData& data, const OutputState* frozen) {
  const Eigen::MatrixXd values = ValuesOf(data);
  std::vector<std::optional<surrogate::GaussianProcess>> fits(
      static_cast<std::size_t>(values.cols()));
  evaluations_.resize(fits.size());
  const auto size = static_cast<double>(data.size());
  base::ParallelFor({.num_items = values.cols(), .item_work = size * size * size / 6},
                    [&](Eigen::Index k) {
                      const auto output = static_cast<std::size_t>(k);
                      std::vector<Eigen::Index>& rows = evaluations_[output];
                      for (Eigen::Index i = 0; i < values.rows(); ++i) {
                        if (std::isfinite(values(i, k))) rows.push_back(i);
                      }
                      surrogate::Evaluations evaluations = RowsOf(data, setup_.levels, rows);
                      evaluations.values = values(rows, k);
                      surrogate::GaussianProcessOptions options =
                          OptionsFor(k, surrogate::StandardDeviation(evaluations.values));
                      if (frozen != nullptr) options.frozen = frozen->processes[output];
                      fits[output] = surrogate::GaussianProcess::Fit(evaluations, options);
                    });
  for (auto& fit : fits) processes_.push_back(*std::move(fit));
}

OutputState OutputModel::state() const {
  OutputState state{.modes = modes_, .processes = {}};
  for (const auto& process : processes_) state.processes.push_back(process.state());
  return state;
}

void OutputModel::ForEachMode(Eigen::Index num_points,
                              const std::function<void(Eigen::Index)>& body) const {
  const auto size = static_cast<double>(num_evaluations_);
  base::ParallelFor({.num_items = num_modes(),
                     .item_work = size * (size / 2 + 40) * static_cast<double>(num_points)},
                    body);
}

ModeMoments OutputModel::PredictModes(const Eigen::MatrixXd& points) const {
  ModeMoments moments{.mean = Eigen::MatrixXd(points.rows(), num_modes()),
                      .variance = Eigen::MatrixXd(points.rows(), num_modes())};
  ForEachMode(points.rows(), [&](Eigen::Index k) {
    const surrogate::Predictions all = output(k).PredictAll(points);
    moments.mean.col(k) = all.mean;
    moments.variance.col(k) = all.variance;
  });
  return moments;
}

std::vector<Eigen::MatrixXd> OutputModel::DrawModes(const Eigen::MatrixXd& points, int num_draws,
                                                    std::uint64_t seed) const {
  std::vector<Eigen::MatrixXd> draws(static_cast<std::size_t>(num_modes()));
  ForEachMode(points.rows(), [&](Eigen::Index k) {
    const auto mode = static_cast<std::size_t>(k);
    draws[mode] =
        output(k).Draw(points, num_draws, base::Random(seed, base::Stream("mode draws"), mode));
  });
  return draws;
}

ModeMoments OutputModel::LeaveModesOut() const {
  const Eigen::Index size = num_modes() > 0 ? output(0).num_points() : 0;
  ModeMoments moments{.mean = Eigen::MatrixXd(size, num_modes()),
                      .variance = Eigen::MatrixXd(size, num_modes())};
  ForEachMode(size, [&](Eigen::Index k) {
    const surrogate::Predictions one = output(k).LeaveOneOut();
    moments.mean.col(k) = one.mean;
    moments.variance.col(k) = one.variance;
  });
  return moments;
}

Eigen::MatrixXd OutputModel::LeaveOneOut() const {
  Eigen::MatrixXd z = Eigen::MatrixXd::Constant(num_evaluations_, num_outputs(), base::kNotKnown);
  for (Eigen::Index k = 0; k < num_outputs(); ++k) {
    const surrogate::Predictions left_out = output(k).LeaveOneOut();
    const Eigen::VectorXd values = output(k).values();
    const std::vector<Eigen::Index>& rows = evaluations_[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const auto first = static_cast<std::size_t>(output(k).first()[i]);
      if (first >= rows.size()) continue;  // a fantasy
      z(rows[first], k) = (values[i] - left_out.mean[i]) / std::sqrt(left_out.variance[i]);
    }
  }
  return z;
}

double OutputModel::TargetNoise(Eigen::Index k) const {
  if (setup_.deterministic) return 0;
  const int finest = setup_.levels.finest();
  const double ratio = setup_.levels.NoiseAtTarget(finest);
  return ratio * ratio * output(k).noise_variance(finest);
}

Eigen::VectorXd OutputModel::ModeNoise() const {
  return Eigen::VectorXd::NullaryExpr(num_modes(), [&](Eigen::Index k) { return TargetNoise(k); });
}

Eigen::VectorXd OutputModel::ElementNoise() const {
  if (setup_.deterministic) return Eigen::VectorXd::Zero(modes_.mean.size());
  return modes_.basis.cwiseAbs2() * ModeNoise() + modes_.discarded;
}

void OutputModel::AddFantasy(const Eigen::VectorXd& x, int level) {
  for (surrogate::GaussianProcess& process : processes_) {
    process.AddFantasy({.x = x, .growth = setup_.levels.growth(level), .level = level});
  }
}

namespace {

// The mean miss of the nearest others of the same scale factor; its own where there are none. Of
// very many a thousand are looked at, evenly in their order.
double MissRound(const OutputData& data, std::span<const double> misses, std::size_t row,
                 std::size_t count) {
  constexpr std::size_t kNearest = 20;
  constexpr std::size_t kMost = 1000;
  const std::size_t looked_at = std::min(count, kMost);
  std::vector<std::pair<double, std::size_t>> others;  // squared distance, row
  others.reserve(looked_at);
  for (std::size_t k = 0; k < looked_at; ++k) {
    const std::size_t i = k * count / looked_at;
    if (i == row || data.level[i] != data.level[row]) continue;
    others.emplace_back((data.points[i] - data.points[row]).squaredNorm(), i);
  }
  if (others.empty()) return misses[row];
  const std::size_t size = std::min(kNearest, others.size());
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(size),
                    others.end());
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += misses[others[i].second];
  return sum / static_cast<double>(size);
}

}  // namespace

std::vector<std::size_t> RowsToModel(const OutputData& data, std::span<const double> misses,
                                     int count) {
  std::vector<std::size_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (count <= kMostEvaluations) return order;
  std::vector<double> round;
  for (const std::size_t row : order) round.push_back(MissRound(data, misses, row, order.size()));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (data.level[a] != data.level[b]) return data.level[a] > data.level[b];
    return round[a] < round[b];
  });
  constexpr std::size_t kHalf = kMostEvaluations / 2;
  std::vector<std::size_t> chosen(order.begin(), order.begin() + kHalf);
  std::vector<std::size_t> others(order.begin() + kHalf, order.end());
  std::sort(others.begin(), others.end());
  for (std::size_t i = 0; i < kHalf; ++i) chosen.push_back(others[i * others.size() / kHalf]);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

OutputData Modelled(const OutputData& data, std::span<const std::size_t> rows) {
  OutputData modelled;
  for (const std::size_t i : rows) {
    modelled.points.push_back(data.points[i]);
    modelled.level.push_back(data.level[i]);
    if (!data.vectors.empty()) modelled.vectors.push_back(data.vectors[i]);
    modelled.scalars.push_back(data.scalars[i]);
  }
  return modelled;
}

}  // namespace talus::optimizer
