// What the evaluations so far say of the parameters.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "optimizer/posterior_summary.h"

namespace talus::optimizer {

// Probability of every range and region that is stated; texts call it 90 %.
inline constexpr double kRegionLevel = 0.9;

// Credible range of one parameter, in the unit cube.
struct Range {
  double low = 0;
  double high = 1;
};

// A parameter that lies on a bound of its range.
struct BoundWarning {
  int parameter = 0;  // by its place in the point
  bool is_upper = false;
};

struct Answer {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  Eigen::VectorXd point;  // minimiser of the posterior mean, unit cube
  // NaN where there is no model that knows it.
  double predicted_value = kUnknown;  // posterior mean there
  // Posterior standard deviation of that mean; 1.5 times it of a process of the values, which is
  // overconfident alike here and in the ranges.
  double predicted_sd = kUnknown;
  double noise_sd = kUnknown;          // noise sd of one evaluation there; 0 when deterministic
  std::vector<Range> credible;         // one a parameter, 90 % for all of them together
  Eigen::MatrixXd correlation;         // between parameters, of the posterior of the minimiser
  std::vector<Eigen::VectorXd> tied;   // points that tie with `point` within the noise
  double tied_volume = kUnknown;       // their share of the unit cube, in [0, 1]; NaN as above
  std::vector<double> sobol_first;     // first-order Sobol index, one a parameter
  std::vector<double> sobol_total;     // total Sobol index, one a parameter
  std::vector<BoundWarning> warnings;  // of `point`
  bool is_guess = false;               // no evaluation has succeeded
  // Leave-one-out error of the model / standard deviation of what it predicts [-]; NaN: not known.
  double left_out_share = kUnknown;
  std::string model;  // which surrogate answered and how well it predicts, in words
  std::optional<PosteriorSummary> posterior = {};  // of strategies that work one out
};

}  // namespace talus::optimizer
