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
  // Prior of n_l / sd of the values, one a scale factor.
  Eigen::VectorXd noise_median;
  Eigen::VectorXd noise_log_sd;
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

  // Points at the target about which evaluations elsewhere would teach something.
  struct Watched {
    Eigen::MatrixXd warped;    // d × m
    Eigen::MatrixXd half;      // n × m, L⁻¹ of their covariances with the evaluations
    Eigen::VectorXd variance;  // of the output there
  };
  Watched Watch(const Eigen::MatrixXd& points) const;  // one point a row

  // Posterior covariance of the output at each watched point with the output at `site`, and the
  // variance of the latter without noise: an evaluation there takes covariance²/(site_variance +
  // noise) from the variance of a watched point.
  struct Teaching {
    Eigen::VectorXd covariance;
    double site_variance = 0;
  };
  Teaching TeachingOf(const Watched& watched, const FidelityPoint& site) const;

  // Each evaluation from all others; the variance includes its noise.
  Predictions LeaveOneOut() const;

  // Adds a fantasy: the prediction there, taken for an evaluation (kriging believer).
  void AddFantasy(const FidelityPoint& at, int level);

  double noise_variance(int level) const;

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
