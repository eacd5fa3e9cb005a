// What simulations say of the outputs of one experiment: the principal modes of its images and the
// numbers beside them, each a Gaussian process over the parameters and, where there are several,
// the scale factors.
//
//   vector(x) = mean + basis c(x) + discarded,   cₖ(x) a Gaussian process with noise
//
// Modes are smooth functions and share no noise with each other, so a handful of processes averages
// the noise of all elements of an image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "optimizer/outputs/experiment_target.h"
#include "optimizer/outputs/levels.h"
#include "surrogate/images/principal_modes.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::optimizer {

// The evaluations of one experiment.
struct OutputData {
  std::vector<Eigen::VectorXd> points = {};  // unit cube
  std::vector<int> level = {};
  std::vector<Eigen::VectorXd> vectors = {};  // images as a code writes them; empty without images
  std::vector<std::vector<double>> scalars = {};

  int size() const { return static_cast<int>(points.size()); }
};

// Everything that fitting decides.
struct OutputState {
  surrogate::PrincipalModes modes;
  std::vector<surrogate::GaussianProcessState> processes;  // modes, then numbers
};

struct OutputSetup {
  Levels levels = Levels({1}, 1);
  std::vector<ScalarTarget> scalars = {};
  bool deterministic = false;  // the same point always gives the same outputs
  std::uint64_t seed = 1;
};

// Normal coefficients of the modes: one point a row, one mode a column.
struct ModeMoments {
  Eigen::MatrixXd mean;
  Eigen::MatrixXd variance;
};

class OutputModel {
 public:
  // `frozen`, where not null, is taken instead of fitting.
  OutputModel(OutputSetup setup, const OutputData& data, const OutputState* frozen);

  int num_outputs() const { return static_cast<int>(processes_.size()); }
  Eigen::Index num_modes() const { return modes_.basis.cols(); }
  const surrogate::PrincipalModes& modes() const { return modes_; }
  const surrogate::GaussianProcess& output(Eigen::Index k) const {
    return processes_[static_cast<std::size_t>(k)];
  }
  const Levels& levels() const { return setup_.levels; }
  OutputState state() const;

  // At the target scale factor, one point a row.
  ModeMoments PredictModes(const Eigen::MatrixXd& points) const;

  // Joint draws of the coefficients: element k holds mode k, one draw a row, one point a column.
  std::vector<Eigen::MatrixXd> DrawModes(const Eigen::MatrixXd& points, int num_draws,
                                         std::uint64_t seed) const;

  // The coefficients of each distinct point from the others, in the order in
  // which they first appear.
  ModeMoments LeaveModesOut() const;

  // Each evaluation, predicted from the others, in its sd: one evaluation a row, one output a
  // column. Replicates count as one: all but the first are NaN, and so are undefined numbers.
  Eigen::MatrixXd LeaveOneOut() const;

  // Variance of one evaluation at the target: of an output; of each mode; of each element of the
  // image, by all modes and by what they leave out.
  double TargetNoise(Eigen::Index output) const;
  Eigen::VectorXd ModeNoise() const;
  Eigen::VectorXd ElementNoise() const;

  // Adds the prediction at x as if it were an evaluation.
  void AddFantasy(const Eigen::VectorXd& x, int level = 0);

 private:
  // The coefficients of the images and the numbers, one evaluation a row; NaN where undefined.
  Eigen::MatrixXd ValuesOf(const OutputData& data) const;
  surrogate::GaussianProcessOptions OptionsFor(Eigen::Index output, double spread) const;
  void FitProcesses(const OutputData& data, const OutputState* frozen);
  // Calls body(k) for each mode, several at once where the work for `num_points` points is large.
  void ForEachMode(Eigen::Index num_points, const std::function<void(Eigen::Index)>& body) const;

  OutputSetup setup_;
  surrogate::PrincipalModes modes_;
  std::vector<surrogate::GaussianProcess> processes_;   // modes, then numbers
  std::vector<std::vector<Eigen::Index>> evaluations_;  // rows of the data that each has
  Eigen::Index num_evaluations_ = 0;
};

// Values far above the target are compressed, so that a mass that spans decades stays smooth where
// it matters. Nearly linear up to the target, and to ten of its errors.
double Compress(const ScalarTarget& target, double value);
double CompressionScale(const ScalarTarget& target);  // Compress = asinh(value / scale)
double CompressedError(const ScalarTarget& target);   // the target's standard error, compressed

// A Gaussian process costs the cube of its evaluations: beyond these an answer takes minutes.
inline constexpr int kMostEvaluations = 400;

// Rows of the first `count` of `data`, or of kMostEvaluations of these: one half are those that
// tell the answer most, of the finest scale factor and then where the others nearby miss least, and
// the other half are spread evenly over the rest, in their order. Its own miss would choose an
// evaluation by its noise, of which the model would then know too little. `misses`: one an
// evaluation, not NaN.
std::vector<std::size_t> RowsToModel(const OutputData& data, std::span<const double> misses,
                                     int count);
OutputData Modelled(const OutputData& data, std::span<const std::size_t> rows);

}  // namespace talus::optimizer
