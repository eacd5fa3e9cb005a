#include "surrogate/images/mode_process.h"

#include <algorithm>
#include <utility>

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
      options.frozen ? options.frozen->modes : FitModes(vectors, options.max_modes);
  const PrincipalModes& modes = process.state_.modes;
  const Eigen::MatrixXd coefficients = (vectors.rowwise() - modes.mean.transpose()) * modes.basis;
  for (Eigen::Index k = 0; k < coefficients.cols(); ++k) {
    GaussianProcessOptions one = options.process;
    if (options.frozen) {
      one.frozen = options.frozen->processes[static_cast<std::size_t>(k)];
    } else if (k >= options.num_own) {
      one.frozen = Rescaled(process.processes_.back().state(), coefficients.col(k));
    } else if (modes.next_sd > 0) {
      one.priors.noise = NoisePrior(modes.next_sd, coefficients.col(k));
    }
    process.processes_.push_back(GaussianProcess::Fit(points, coefficients.col(k), one));
    process.state_.processes.push_back(process.processes_.back().state());
  }
  return process;
}

ModeMoments ModeProcess::Predict(const Eigen::MatrixXd& points) const {
  const auto count = static_cast<Eigen::Index>(processes_.size());
  ModeMoments moments{.mean = Eigen::MatrixXd(points.rows(), count),
                      .variance = Eigen::MatrixXd(points.rows(), count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const Predictions all = processes_[static_cast<std::size_t>(k)].PredictAll(points);
    moments.mean.col(k) = all.mean;
    moments.variance.col(k) = all.variance;
  }
  return moments;
}

std::vector<Eigen::MatrixXd> ModeProcess::Draw(const Eigen::MatrixXd& points, int num_draws,
                                               std::uint64_t seed) const {
  std::vector<Eigen::MatrixXd> draws;
  for (const GaussianProcess& process : processes_) {
    draws.push_back(process.Draw(points, num_draws,
                                 base::Random(seed, base::Stream("mode draws"), draws.size())));
  }
  return draws;
}

ModeMoments ModeProcess::LeaveOneOut() const {
  ModeMoments moments;
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    const Predictions one = processes_[k].LeaveOneOut();
    if (k == 0) {
      moments.mean.resize(one.mean.size(), static_cast<Eigen::Index>(processes_.size()));
      moments.variance.resizeLike(moments.mean);
    }
    moments.mean.col(static_cast<Eigen::Index>(k)) = one.mean;
    moments.variance.col(static_cast<Eigen::Index>(k)) = one.variance;
  }
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
