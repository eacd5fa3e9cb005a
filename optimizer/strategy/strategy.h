// Ask–tell: what every way of choosing the next simulations looks like to a campaign.
//
// A strategy works in the unit cube. Its state = the observations told so far, in order: a fresh
// one told the same makes the same next proposal, bit for bit.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimizer/answer.h"
#include "optimizer/moments.h"
#include "optimizer/observation.h"
#include "optimizer/posterior_summary.h"
#include "optimizer/search/stopping_rule.h"

namespace talus::optimizer {

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
