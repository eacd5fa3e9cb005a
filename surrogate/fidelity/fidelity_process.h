// Gaussian process of one output over parameters and scale factor (fidelity_covariance.h).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "surrogate/fidelity/fidelity_covariance.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::surrogate {

// Everything that fitting decides; handing it to another Fit freezes it.
struct FidelityState {
  FidelityHyper hyper;  // in units of the scaled values
  double centre = 0;    // mean of the values
  double scale = 1;     // their standard deviation
};

struct FidelityFitOptions {
  Eigen::VectorXd noise_median;  // prior median of n_l / sd of the values, one a scale factor
  double noise_log_sd = 0.7;
  std::optional<FidelityState> frozen = {};  // take this, fit nothing
};

// Where the process is asked: parameters and growth of the discrepancy (0 at the target).
struct FidelityPoint {
  Eigen::VectorXd x;
  double growth = 0;
};

class FidelityProcess {
 public:
  // `data.values` in their own units; they are scaled here.
  static FidelityProcess Fit(FidelityData data, const FidelityFitOptions& options);

  // Mean and variance of the output without noise, one point a row, all with growth `growth`.
  Predictions Predict(const Eigen::MatrixXd& points, double growth) const;

  // Posterior covariance of the output at the target with the output at the same x and growth
  // `growth`, and the variance of the latter: what an evaluation there would teach.
  struct Bridge {
    double variance = 0;  // at the target
    double covariance = 0;
    double coarse_variance = 0;  // at `growth`, without noise
  };
  Bridge BridgeAt(const FidelityPoint& at) const;

  // Each evaluation from all others; the variance includes its noise.
  Predictions LeaveOneOut() const;

  // Adds a fantasy: the prediction there, taken for an evaluation (kriging believer).
  void AddFantasy(const FidelityPoint& at, int level);

  double noise_variance(int level) const;
  // sd of the linear discrepancy that the prior allows, and that evaluations leave, averaged over
  // the evaluated points at growth 1: a ratio near 1 says that it was not learnt.
  double DiscrepancyLeft() const;

  const FidelityState& state() const { return state_; }
  Eigen::VectorXd values() const { return state_.centre + state_.scale * data_.values.array(); }

 private:
  FidelityProcess(FidelityData data, FidelityState state);
  void Factorise();
  Eigen::MatrixXd Cross(const Eigen::MatrixXd& warped, double growth) const;  // n × m

  FidelityData data_;  // values scaled
  FidelityState state_;
  Eigen::MatrixXd warped_;
  Eigen::MatrixXd lower_;  // Cholesky factor of K
  Eigen::VectorXd alpha_;
};

}  // namespace talus::surrogate
