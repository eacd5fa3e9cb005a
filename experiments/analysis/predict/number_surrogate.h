// A number of a predicted test as a function of the parameters: a Gaussian process over the means
// of the draws that were simulated. Their noise is known from the scatter of their runs.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "experiments/analysis/predict/prediction.h"
#include "optimizer/space/parameter_space.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::analysis {

class NumberSurrogate {
 public:
  static constexpr int kFewest = 6;  // draws with a value that it can stand on

  // None where fewer draws have the number.
  static std::optional<NumberSurrogate> Fit(const Prediction& prediction,
                                            const PredictedNumber& number,
                                            const optimizer::ParameterSpace& space);

  // What runs of each set give on average: one point of the unit cube a row. The variance is that
  // of this mean.
  surrogate::Predictions At(const Eigen::MatrixXd& points) const;

  // Root mean square by which it misses the mean of a draw that it was not told; a mean's own
  // scatter is in it.
  double left_out_error() const { return left_out_error_; }

 private:
  NumberSurrogate() = default;

  // None: the number is the same everywhere.
  std::optional<surrogate::GaussianProcess> process_;
  double constant_ = 0;
  double left_out_error_ = 0;
};

}  // namespace talus::analysis
