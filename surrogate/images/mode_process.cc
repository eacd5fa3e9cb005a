#include "surrogate/images/mode_process.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_for.h"
#include "surrogate/standard_deviation.h"

namespace talus::surrogate {
namespace {

// The strongest mode left out is nearly all noise, and the noise of one evaluation is about the
// same along every mode, somewhat larger along the strong ones. Without this prior the weak modes,
// seen a few times, pass for signal.
LogNormal NoisePrior(double next_sd, const Eigen::VectorXd& coefficients) {
  constexpr double kStronger = 1.5;
  // Shares of the standard deviation of the coefficients. Noise may also have few dimensions, all
  // of them among the modes kept; and a mode is kept for some signal.
  constexpr double kLeast = 0.1;
  constexpr double kMost = 0.8;
  constexpr double kLogSd = 0.7;
  const double expected = kStronger * next_sd / StandardDeviation(coefficients);
  return {.median = std::clamp(expected, kLeast, kMost), .log_sd = kLogSd};
}

// A state for a weak mode: the correlation of a stronger one at its own scale.
GaussianProcessState Rescaled(GaussianProcessState state, const Eigen::VectorXd& values) {
  state.centre = values.mean();
  state.scale = StandardDeviation(values);
  if (!(state.scale > 0)) state.scale = 1;
  return state;
}

}  // namespace

ModeProcess ModeProcess::Fit(const Eigen::MatrixXd& points, const Eigen::MatrixXd& vectors,
                             const ModeOptions& options) {
  ModeProcess process;
  process.num_parameters_ = static_cast<int>(points.cols());
  process.deterministic_ = options.process.deterministic;
  process.state_.modes =
      options.frozen ? options.frozen->modes
                     : FitModes(vectors, Eigen::VectorXd::Ones(vectors.rows()), options.max_modes);
  const PrincipalModes& modes = process.state_.modes;
  const Eigen::MatrixXd coefficients = (vectors.rowwise() - modes.mean.transpose()) * modes.basis;
  const Eigen::Index count = coefficients.cols();
  const Eigen::Index num_own =
      options.frozen ? count : std::min<Eigen::Index>(count, options.num_own);
  std::vector<std::optional<GaussianProcess>> fits(static_cast<std::size_t>(count));
  const auto fit = [&](Eigen::Index k) {
    GaussianProcessOptions one = options.process;
    if (options.frozen) {
      one.frozen = options.frozen->processes[static_cast<std::size_t>(k)];
    } else if (k >= num_own) {
      one.frozen =
          Rescaled(fits[static_cast<std::size_t>(num_own) - 1]->state(), coefficients.col(k));
    } else if (modes.next_sd > 0) {
      one.priors.noise = NoisePrior(modes.next_sd, coefficients.col(k));
    }
    fits[static_cast<std::size_t>(k)] = GaussianProcess::Fit(points, coefficients.col(k), one);
  };
  const double factor_work = std::pow(static_cast<double>(points.rows()), 3) / 6;
  base::ParallelFor({.num_items = num_own, .item_work = factor_work}, fit);
  base::ParallelFor({.num_items = count - num_own, .item_work = factor_work},
                    [&](std::int64_t i) { fit(num_own + i); });
  for (std::optional<GaussianProcess>& one : fits) {
    process.state_.processes.push_back(one->state());
    process.processes_.push_back(*std::move(one));
  }
  return process;
}

void ModeProcess::ForEachMode(Eigen::Index num_points,
                              const std::function<void(std::int64_t)>& body) const {
  const auto size = processes_.empty() ? 0.0 : static_cast<double>(processes_[0].num_points());
  base::ParallelFor({.num_items = static_cast<std::int64_t>(processes_.size()),
                     .item_work = size * (size / 2 + 40) * static_cast<double>(num_points)},
                    body);
}

ModeMoments ModeProcess::Predict(const Eigen::MatrixXd& points) const {
  const auto count = static_cast<Eigen::Index>(processes_.size());
  ModeMoments moments{.mean = Eigen::MatrixXd(points.rows(), count),
                      .variance = Eigen::MatrixXd(points.rows(), count)};
  ForEachMode(points.rows(), [&](std::int64_t k) {
    const Predictions all = processes_[static_cast<std::size_t>(k)].PredictAll(points);
    moments.mean.col(k) = all.mean;
    moments.variance.col(k) = all.variance;
  });
  return moments;
}

std::vector<Eigen::MatrixXd> ModeProcess::Draw(const Eigen::MatrixXd& points, int num_draws,
                                               std::uint64_t seed) const {
  std::vector<Eigen::MatrixXd> draws(processes_.size());
  ForEachMode(points.rows(), [&](std::int64_t k) {
    const auto mode = static_cast<std::size_t>(k);
    draws[mode] = processes_[mode].Draw(points, num_draws,
                                        base::Random(seed, base::Stream("mode draws"), mode));
  });
  return draws;
}

ModeMoments ModeProcess::LeaveOneOut() const {
  const auto count = static_cast<Eigen::Index>(processes_.size());
  const Eigen::Index size = processes_.empty() ? 0 : processes_[0].num_points();
  ModeMoments moments{.mean = Eigen::MatrixXd(size, count),
                      .variance = Eigen::MatrixXd(size, count)};
  ForEachMode(size, [&](std::int64_t k) {
    const Predictions one = processes_[static_cast<std::size_t>(k)].LeaveOneOut();
    moments.mean.col(k) = one.mean;
    moments.variance.col(k) = one.variance;
  });
  return moments;
}

void ModeProcess::Add(const Eigen::VectorXd& x, const Eigen::VectorXd& vector) {
  const Eigen::VectorXd coefficients = state_.modes.Coefficients(vector);
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    processes_[k].Add(x, coefficients[static_cast<Eigen::Index>(k)]);
  }
}

Eigen::VectorXd ModeProcess::ModeNoise() const {
  Eigen::VectorXd noise(static_cast<Eigen::Index>(processes_.size()));
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    noise[static_cast<Eigen::Index>(k)] = deterministic_ ? 0 : processes_[k].noise_variance();
  }
  return noise;
}

Eigen::VectorXd ModeProcess::ElementNoise() const {
  if (deterministic_) return Eigen::VectorXd::Zero(state_.modes.mean.size());
  return state_.modes.basis.cwiseAbs2() * ModeNoise() + state_.modes.discarded;
}

}  // namespace talus::surrogate
