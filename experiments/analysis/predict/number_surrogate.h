// A number of a predicted test as a function of the parameters and, where several were simulated,
// of the scale factor: a Gaussian process over the runs of its draws.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "experiments/analysis/predict/prediction.h"
#include "experiments/rigs/observables/observable.h"
#include "optimizer/space/parameter_space.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::analysis {

// The prediction's draws in the unit cube, one a row.
Eigen::MatrixXd PointsOf(const Prediction& prediction, const optimizer::ParameterSpace& space);

class NumberSurrogate {
 public:
  static constexpr int kFewest = 6;  // draws with a value that it can stand on
  // Runs at one scale factor that have the number: fewer do not show what the scale factor changes.
  static constexpr int kFewestRuns = 4;

  // None where fewer draws have the number.
  static std::optional<NumberSurrogate> Fit(const Prediction& prediction,
                                            const PredictedNumber& number,
                                            const optimizer::ParameterSpace& space);

  // The scale factor that it tells: the prediction's target where runs at several have the number,
  // else that of the draws. Finer runs, too few to count, are left out.
  double scale_factor() const { return scale_factor_; }
  // What runs of each set give on average at that scale factor: one point of the unit cube a row;
  // never beyond what the number can be. The variance is that of this mean.
  surrogate::Predictions At(const Eigen::MatrixXd& points) const;
  // Standard deviation of a single run there.
  double run_sd() const { return run_sd_; }

  // Root mean squares of what misses the mean of a draw's runs that was not told, with all the runs
  // of that draw; a mean's own scatter is in it. Of the runs at the prediction's scale factor and
  // at finer ones.
  double left_out_error() const { return left_out_error_; }  // by this surrogate
  double draws_error() const { return draws_error_; }        // by the mean of the other draws

 private:
  NumberSurrogate() = default;

  // None: the number is the same everywhere.
  std::optional<surrogate::GaussianProcess> process_;
  double scale_factor_ = 1;
  double constant_ = 0;
  rigs::Bounds bounds_;
  double run_sd_ = 0;
  double left_out_error_ = 0;
  double draws_error_ = 0;
};

}  // namespace talus::analysis
