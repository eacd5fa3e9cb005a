// Gaussian process regression on the unit cube: the predictor behind the scalar and field models.
//
//   mean(x) = b + a kᵀ K⁻¹ y,   variance(x) = a² (k(x, x) - kᵀ K⁻¹ k),   y = (values - b) / a
//
// b, a: mean and standard deviation of the values; k, K: covariance.h, likelihood.h. The variance
// is that of the mean function; one evaluation has noise_variance() on top of it.
// Replicates are pooled exactly. Hyper-parameters by maximum a posteriori from several starts,
// unless frozen. Points have one point a row, as everywhere outside this folder.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/random.h"
#include "surrogate/process/covariance.h"
#include "surrogate/process/likelihood.h"

namespace talus::surrogate {

// Everything that fitting decides; handing it to another Fit freezes it.
struct GaussianProcessState {
  Hyperparameters hyper = {};  // in units of the scaled values
  double centre = 0;           // b
  double scale = 1;            // a
};

struct GaussianProcessOptions {
  Kernel kernel = Kernel::kMatern52;
  Trend trend = Trend::kConstant;
  bool warp_inputs = false;    // infer an input warping of each coordinate (warp.h)
  bool deterministic = false;  // the same point always gives the same value: noise = floor
  double noise_floor = 1e-8;   // least noise variance / variance of the values, > 0
  HyperPriors priors = {};
  int num_starts = 2;                         // local searches, from the best of the trial starts
  int num_trial_starts = 8;                   // prior median, `start`, and draws from the prior
  int max_evaluations = 60;                   // of the likelihood, a local search
  std::uint64_t seed = 1;                     // of the draws from the prior
  std::optional<Hyperparameters> start = {};  // one more trial start
  std::optional<GaussianProcessState> frozen = {};  // take these, fit nothing
};

struct Prediction {
  double mean = 0;
  double variance = 0;
};

struct Predictions {
  Eigen::VectorXd mean;
  Eigen::VectorXd variance;
};

struct PredictionGradient {
  Prediction value;
  Eigen::VectorXd mean;      // d mean / dx
  Eigen::VectorXd variance;  // d variance / dx
};

// A fixed set of points, prepared for covariances with many others. Valid until Add.
struct AnchorPoints {
  Eigen::MatrixXd columns;   // as the covariance sees them
  Eigen::MatrixXd whitened;  // L⁻¹ k(X, points)
};

struct Covariances {
  Eigen::MatrixXd between;   // posterior covariance, one anchor a row, one other point a column
  Eigen::VectorXd variance;  // of the other points
};

class GaussianProcess {
 public:
  // `points` n × d with n >= 1, `values` n.
  static GaussianProcess Fit(const Eigen::MatrixXd& points, const Eigen::VectorXd& values,
                             const GaussianProcessOptions& options);

  Prediction Predict(const Eigen::VectorXd& x) const;
  Predictions PredictAll(const Eigen::MatrixXd& points) const;
  PredictionGradient PredictWithGradient(const Eigen::VectorXd& x) const;

  AnchorPoints Anchor(const Eigen::MatrixXd& points) const;
  Covariances PosteriorCovariances(const AnchorPoints& anchors,
                                   const Eigen::MatrixXd& points) const;

  // Joint draws of the mean function: one draw a row, one point a column.
  Eigen::MatrixXd Draw(const Eigen::MatrixXd& points, int num_draws, base::Random random) const;

  // Each distinct point, with all its replicates, predicted from the others; the variance is that
  // of its (mean) value, noise included. Rows as in points().
  Predictions LeaveOneOut() const;

  // Adds one evaluation in O(n²); hyper-parameters, centre and scale stay.
  void Add(const Eigen::VectorXd& x, double value);
  // Adds the prediction at x as if it were an evaluation, and returns it (the kriging believer).
  double AddFantasy(const Eigen::VectorXd& x);

  double noise_variance() const;  // of one evaluation
  double LogLikelihood() const;   // of the values, in their own units
  double LogPosterior() const;    // with the prior of the hyper-parameters, where they were fitted
  const GaussianProcessState& state() const { return state_; }
  Eigen::Index dimension() const { return data_.points.rows(); }
  Eigen::Index num_points() const { return data_.values.size(); }  // distinct
  Eigen::MatrixXd points() const { return data_.points.transpose(); }
  Eigen::VectorXd values() const;  // means over replicates

 private:
  GaussianProcess(PooledData data, GaussianProcessState state, Kernel kernel);
  Eigen::MatrixXd Columns(const Eigen::MatrixXd& points) const;  // warped, one a column
  void Factorise();
  void AppendRow(const Eigen::VectorXd& x);

  PooledData data_;         // values scaled
  Eigen::MatrixXd warped_;  // points as the covariance sees them, d × u
  GaussianProcessState state_;
  Covariance covariance_;
  Eigen::MatrixXd lower_;  // L, K = L Lᵀ; only the lower triangle is meant
  Eigen::VectorXd alpha_;  // K⁻¹ y
  double jitter_ = 0;      // added to the diagonal where rounding made K indefinite
  double log_prior_ = 0;
};

}  // namespace talus::surrogate
