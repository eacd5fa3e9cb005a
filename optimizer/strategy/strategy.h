// Ask–tell: what every way of choosing the next simulations looks like to a campaign.
//
// A strategy works in the unit cube. Its state = the observations told so far, in order: a fresh
// one told the same makes the same next proposal, bit for bit.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "optimizer/answer.h"
#include "optimizer/observation.h"
#include "optimizer/stop_reason.h"

namespace talus::optimizer {

class Strategy {
 public:
  virtual ~Strategy() = default;

  // The next `count` points (1 … 8; fewer, down to none, when the strategy has no more). `pending`
  // are the points asked for earlier and not told yet.
  virtual std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) = 0;
  virtual void Tell(const Observation& observation) = 0;

  // When going on is not worth it.
  virtual std::optional<StopReason> WhyStop() = 0;
  // What that still lacks; nothing where it is met, switched off or where there is no rule.
  virtual std::optional<StopShortfall> Shortfall() { return std::nullopt; }
  virtual Answer Recommend() = 0;

  // As Ask, for strategies that choose experiments and scale factors too.
  virtual std::vector<Proposal> AskAt(int count, std::span<const Proposal> pending) {
    std::vector<Eigen::VectorXd> points;
    for (const Proposal& p : pending) points.push_back(p.point);
    return Ask(count, points);
  }
};

}  // namespace talus::optimizer
