// What the evaluations so far say of the parameters.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "base/not_known.h"
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
  Eigen::VectorXd point;  // minimiser of the posterior mean, unit cube
  // NaN where there is no model that knows it.
  double predicted_value = base::kNotKnown;  // posterior mean there
  // Posterior standard deviation of that mean; 1.5 times it of a process of the values, which is
  // overconfident alike here and in the ranges.
  double predicted_sd = base::kNotKnown;
  double noise_sd = base::kNotKnown;     // noise sd of one evaluation there; 0 when deterministic
  std::vector<Range> credible;           // one a parameter, 90 % for all of them together
  Eigen::MatrixXd correlation;           // between parameters, of the posterior of the minimiser;
                                         // empty without a model
  std::vector<Eigen::VectorXd> tied;     // points that tie with `point` within the noise
  double tied_volume = base::kNotKnown;  // their share of the unit cube, in [0, 1]; NaN as above
  std::vector<double> sobol_first;       // first-order Sobol index, one a parameter
  std::vector<double> sobol_total;       // total Sobol index, one a parameter
  std::vector<BoundWarning> warnings;    // of `point`
  bool is_guess = false;                 // no evaluation has succeeded
  // Leave-one-out error of the model / standard deviation of what it predicts [-]; NaN: not known.
  double left_out_share = base::kNotKnown;
  std::string model;  // which surrogate answered and how well it predicts, in words
  std::optional<PosteriorSummary> posterior = {};  // of strategies that work one out
};

}  // namespace talus::optimizer
