// A strategy on a table, which sees its coordinates by rank (level_ranks.h); who asks it sees them
// as they are.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "optimizer/space/domain.h"
#include "optimizer/space/level_ranks.h"
#include "optimizer/strategy/strategy.h"

namespace talus::optimizer {

class RankedStrategy : public Strategy {
 public:
  // `make` makes the strategy of the domain it is given. `domain` is a list.
  RankedStrategy(const Domain& domain,
                 const std::function<std::unique_ptr<Strategy>(const Domain&)>& make);

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  void Tell(const Observation& observation) override;
  std::optional<StopReason> WhyStop() override { return inner_->WhyStop(); }
  std::optional<StopShortfall> Shortfall() override { return inner_->Shortfall(); }
  Answer Recommend() override;

 private:
  // The candidate itself, without the rounding of the way to its ranks and back.
  Eigen::VectorXd Candidate(const Eigen::VectorXd& ranks) const;

  Domain domain_;
  LevelRanks ranks_;
  std::unique_ptr<Strategy> inner_;
};

}  // namespace talus::optimizer
