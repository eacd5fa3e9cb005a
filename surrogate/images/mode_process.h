// A long vector (the edges or pixels of an image) as a function of the parameters: principal modes,
// and a Gaussian process for the coefficient of each.
//
//   vector(x) = mean + basis c(x) + discarded,   cₖ(x) a Gaussian process with noise
//
// Modes are smooth functions and share no noise with each other, so a handful of processes averages
// the noise of all elements. The strongest modes get hyper-parameters of their own, the weak ones
// those of the last of these: their signal is too small to tell any.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "surrogate/images/principal_modes.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::surrogate {

// Everything that fitting decides; handing it to another Fit freezes it.
struct ModeState {
  PrincipalModes modes;
  std::vector<GaussianProcessState> processes;
};

struct ModeOptions {
  int max_modes = 6;
  int num_own = 6;                                 // modes with hyper-parameters of their own
  GaussianProcessOptions process = {};             // of each mode
  std::optional<ModeState> frozen = std::nullopt;  // take this, fit nothing
};

// Coefficients: one point a row, one mode a column.
struct ModeMoments {
  Eigen::MatrixXd mean;
  Eigen::MatrixXd variance;
};

class ModeProcess {
 public:
  // `points` n × d, `vectors` n × m, n >= 1.
  static ModeProcess Fit(const Eigen::MatrixXd& points, const Eigen::MatrixXd& vectors,
                         const ModeOptions& options);

  ModeMoments Predict(const Eigen::MatrixXd& points) const;

  // Joint draws of the coefficients: element k holds mode k, one draw a row, one point a column.
  std::vector<Eigen::MatrixXd> Draw(const Eigen::MatrixXd& points, int num_draws,
                                    std::uint64_t seed) const;

  // Each distinct point from the others, in the order of GaussianProcess::points().
  ModeMoments LeaveOneOut() const;

  void Add(const Eigen::VectorXd& x, const Eigen::VectorXd& vector);

  // Noise variance of one evaluation: of each mode; of each element, by all modes and by what they
  // leave out.
  Eigen::VectorXd ModeNoise() const;
  Eigen::VectorXd ElementNoise() const;

  int num_parameters() const { return num_parameters_; }
  const ModeState& state() const { return state_; }
  const PrincipalModes& modes() const { return state_.modes; }
  const std::vector<GaussianProcess>& processes() const { return processes_; }

 private:
  // Calls body(k) of each mode, several at once where work for `num_points` points is large.
  void ForEachMode(Eigen::Index num_points, const std::function<void(std::int64_t)>& body) const;

  ModeState state_;
  std::vector<GaussianProcess> processes_;
  int num_parameters_ = 0;
  bool deterministic_ = false;
};

}  // namespace talus::surrogate
