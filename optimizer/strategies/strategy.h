// Ask–tell: what every way of choosing the next simulations looks like to a campaign.
//
// A strategy works in the unit cube. Its state = the observations told so far, in order: a fresh
// one told the same makes the same next proposal, bit for bit.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimizer/fidelity/posterior_summary.h"
#include "optimizer/models/moments.h"
#include "optimizer/stopping/stopping_rule.h"

namespace talus::optimizer {

enum class Origin { kDesign, kRepeat, kModel, kSearch };  // why a point was proposed

struct Proposal {
  Eigen::VectorXd point;  // unit cube, size = number of parameters
  Origin origin = Origin::kModel;
  int experiment = 0;       // which of the experiments to simulate
  double scale_factor = 0;  // of the coarse graining, >= 1; 0: the only one there is
};

// One finished evaluation: one simulation of one experiment.
struct Observation {
  Eigen::VectorXd point;             // unit cube
  int experiment = 0;                // which of the experiments was simulated
  double scale_factor = 1;           // of the coarse graining [-], >= 1
  double cost = 0;                   // [core seconds]; 0: not known
  bool failed = false;               // crashed or infeasible: value and field mean nothing
  double value = 0;                  // the objective, to be minimised
  std::vector<float> field = {};     // the whole image, row by row from the top, in [0, 1] with 1 =
                                     // powder; empty where an evaluation is only a number
  std::vector<double> scalars = {};  // what else was measured, in the experiment's order and units;
                                     // NaN where it is not defined
};

// The same without its image, for strategies to keep: many images would fill the memory, and a
// vector that is only cleared keeps its own.
inline Observation WithoutImage(Observation observation) {
  observation.field = std::vector<float>();
  return observation;
}

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

// What the evaluations so far say.
struct Answer {
  Eigen::VectorXd point;               // minimiser of the posterior mean, unit cube
  double predicted_value = 0;          // posterior mean there
  double predicted_sd = 0;             // posterior standard deviation of that mean
  double noise_sd = 0;                 // noise sd of one evaluation there; 0 when deterministic
  std::vector<Range> credible;         // one a parameter, 90 % for all of them together
  Eigen::MatrixXd correlation;         // between parameters, of the posterior of the minimiser
  std::vector<Eigen::VectorXd> tied;   // points that tie with `point` within the noise
  double tied_volume = 0;              // their share of the unit cube, in [0, 1]
  std::vector<double> sobol_first;     // first-order Sobol index, one a parameter
  std::vector<double> sobol_total;     // total Sobol index, one a parameter
  std::vector<BoundWarning> warnings;  // of `point`
  bool is_guess = false;               // no evaluation has succeeded
  // Leave-one-out error of the model / standard deviation of what it predicts [-]; NaN: not known.
  double left_out_share = std::numeric_limits<double>::quiet_NaN();
  std::string model;  // which surrogate answered and how well it predicts, in words
  std::optional<PosteriorSummary> posterior = {};  // of strategies that work one out
};

class Strategy {
 public:
  virtual ~Strategy() = default;

  // The next `count` points (1 … 8; fewer, down to none, when the strategy has no more). `pending`
  // are the points asked for earlier and not told yet.
  virtual std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) = 0;
  virtual void Tell(const Observation& observation) = 0;

  // In words, when going on is not worth it ("what is left to gain is below 0.7 × the noise sd").
  virtual std::optional<std::string> StopReason() = 0;
  // What that still lacks; nothing where it is met, switched off or where there is no rule.
  virtual std::optional<StopShortfall> Shortfall() { return std::nullopt; }
  virtual Answer Recommend() = 0;

  // As Ask, for strategies that choose experiments and scale factors too.
  virtual std::vector<Proposal> AskAt(int count, std::span<const Proposal> pending) {
    std::vector<Eigen::VectorXd> points;
    for (const Proposal& p : pending) points.push_back(p.point);
    return Ask(count, points);
  }
  // Where a set stands in the posterior; nothing for strategies without one.
  virtual std::optional<Standing> Consider(const Eigen::VectorXd& /*point*/) {
    return std::nullopt;
  }
  // Its credible level alone, of many: one point a row.
  virtual std::optional<Eigen::VectorXd> CredibleLevels(const Eigen::MatrixXd& /*points*/) {
    return std::nullopt;
  }
  // The objective of an experiment by the model that Recommend answers with, one point a row; at
  // the target scale factor where there are several. Nothing for strategies without a model, for
  // experiments without an image, and before there are evaluations enough. A standard deviation
  // that the model does not know is NaN.
  virtual std::optional<Moments> Predict(const Eigen::MatrixXd& /*points*/, int /*experiment*/) {
    return std::nullopt;
  }
};

}  // namespace talus::optimizer
