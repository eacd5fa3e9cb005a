#include "optimizer/strategies/surrogate_strategy.h"

namespace talus::optimizer {

std::vector<Proposal> SurrogateStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  Points asked(pending.begin(), pending.end());
  std::vector<Proposal> proposals;
  for (int i = 0; i < count; ++i) {
    proposals.push_back(Next(asked));
    asked.push_back(proposals.back().point);
  }
  return proposals;
}

Proposal SurrogateStrategy::Next(const Points& asked) {
  if (const auto first = record_.BeforeModel(asked)) return *first;
  if (record_.history().size() < 2) {
    return record_.ReplicateOrPerturb(record_.MostFeasible(record_.StepSeed(asked)), asked);
  }
  return ByModel(asked);
}

void SurrogateStrategy::Tell(const Observation& observation) {
  record_.Tell(observation);
  Update(observation);
}

}  // namespace talus::optimizer
