// Gaussian process regression on the unit cube and, where there are several, over scale factors:
// the one predictor behind every model.
//
//   mean(x) = b + a kᵀ K⁻¹ y,   variance(x) = a² (k(x, x) - kᵀ K⁻¹ k),   y = (values - b) / a
//
// b, a: mean and standard deviation of the values; k, K: covariance.h, likelihood.h. The variance
// is that of the mean function; one evaluation has noise_variance() on top of it. Predictions are
// for the target scale factor unless a growth (covariance.h) is given.
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

// How hard the search for the hyper-parameters tries.
struct FitEffort {
  int num_starts = 8;        // prior median, `start`, and draws from the prior; with several scale
                             // factors one more, that they tell nothing of each other
  int num_searches = 2;      // local searches, from the best of the starts
  int max_evaluations = 60;  // of the likelihood, a local search
  double relative_tolerance = 1e-7;
  bool may_thin = true;  // of many points a part decides (map_fit.cc)
};

struct GaussianProcessOptions {
  Kernel kernel = Kernel::kMatern52;
  Trend trend = Trend::kConstant;
  bool warp_inputs = false;    // infer an input warping of each coordinate (warp.h)
  bool deterministic = false;  // the same point always gives the same value: noise = floor
  double noise_floor = 1e-8;   // noise variance / variance of the values then, > 0
  double usual_sd = 0;         // of the values, for some that are all the same; 0: their own size
  HyperPriors priors = {};     // noise: as many as there are scale factors
  FitEffort effort = {};
  std::uint64_t seed = 1;                           // of the draws from the prior
  std::optional<Hyperparameters> start = {};        // one more trial start
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
  Sites sites;               // as the covariance sees them, at the target
  Eigen::MatrixXd whitened;  // L⁻¹ k(X, points)
  Eigen::VectorXd variance;  // posterior variance of the output there
};

struct Covariances {
  Eigen::MatrixXd between;   // posterior covariance, one anchor a row, one other point a column
  Eigen::VectorXd variance;  // of the other points
};

class GaussianProcess {
 public:
  // At least one evaluation, all values finite.
  static GaussianProcess Fit(const Evaluations& evaluations, const GaussianProcessOptions& options);

  Prediction Predict(const Eigen::VectorXd& x) const;
  Predictions PredictAll(const Eigen::MatrixXd& points, double growth = 0) const;
  PredictionGradient PredictWithGradient(const Eigen::VectorXd& x) const;

  AnchorPoints Anchor(const Eigen::MatrixXd& points) const;
  // With outputs at `points` whose discrepancy has grown by `growth`. An evaluation there takes
  // between²/(variance + noise) from the variance of an anchor.
  Covariances PosteriorCovariances(const AnchorPoints& anchors, const Eigen::MatrixXd& points,
                                   double growth = 0) const;

  // Joint draws of the mean function: one draw a row, one point a column.
  Eigen::MatrixXd Draw(const Eigen::MatrixXd& points, int num_draws, base::Random random) const;

  // Each distinct point, with all its replicates, predicted from the others; the variance is that
  // of its (mean) value, noise included. Rows in order of first appearance.
  Predictions LeaveOneOut() const;

  // Adds one evaluation in O(n²); hyper-parameters, centre and scale stay.
  void Add(const Site& site, double value);
  // Adds the prediction there as if it were an evaluation, and returns it (the kriging believer).
  double AddFantasy(const Site& site);

  double noise_variance(int level = 0) const;  // of one evaluation
  double LogLikelihood() const;                // of the values, in their own units
  double LogPosterior() const;  // with the prior of the hyper-parameters, where they were fitted
  const GaussianProcessState& state() const { return state_; }
  Eigen::Index num_points() const { return data_.size(); }      // distinct
  const Eigen::VectorXi& first() const { return data_.first; }  // evaluation of each, from 0
  Eigen::VectorXd values() const;                               // means over replicates

 private:
  GaussianProcess(PooledData data, GaussianProcessState state, Kernel kernel);
  Sites Warp(const Eigen::MatrixXd& points, double growth) const;
  void Factorise();
  void AppendRow(const Site& site);

  PooledData data_;  // values scaled
  Sites warped_;     // points as the covariance sees them
  GaussianProcessState state_;
  Covariance covariance_;
  Eigen::MatrixXd lower_;  // L, K = L Lᵀ; only the lower triangle is meant
  Eigen::VectorXd alpha_;  // K⁻¹ y
  double jitter_ = 0;      // added to the diagonal, so that rounding does not make K indefinite
  double log_prior_ = 0;
};

}  // namespace talus::surrogate
