#include "optimizer/strategy/surrogate_strategy.h"

namespace talus::optimizer {

std::vector<Proposal> SurrogateStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  Points asked(pending.begin(), pending.end());
  std::vector<Proposal> proposals;
  for (int i = 0; i < count; ++i) {
    const auto next = Next(asked);
    if (!next) break;
    proposals.push_back(*next);
    asked.push_back(proposals.back().point);
  }
  return proposals;
}

std::optional<Proposal> SurrogateStrategy::Next(const Points& asked) {
  if (const auto first = record_.BeforeModel(asked)) return *first;
  if (record_.domain().IsList() && !record_.OpenDomain(asked).IsList()) return std::nullopt;
  if (record_.history().size() < 2) {
    return record_.ReplicateOrPerturb(record_.MostFeasible(asked), asked);
  }
  return ByModel(asked);
}

void SurrogateStrategy::Tell(const Observation& observation) {
  if (!observation.failed) RequireUsable(observation);
  record_.Tell(observation);
  Update(observation);
}

std::optional<StopShortfall> SurrogateStrategy::Shortfall() {
  if (record_.options().stop_multiple == 0 || WhyStop()) return std::nullopt;
  return StopShortfall{.lack = StopLack::kGain};
}

}  // namespace talus::optimizer
