#include "optimizer/strategy/ranked_strategy.h"

#include "optimizer/search/describe_minimum.h"

namespace talus::optimizer {
namespace {

Domain ByRanks(const Domain& domain, const LevelRanks& ranks) {
  Domain ranked = domain;
  for (Eigen::VectorXd& guess : ranked.guesses) guess = ranks.ToRanks(guess);
  for (Eigen::Index i = 0; i < domain.candidates.rows(); ++i) {
    ranked.candidates.row(i) = ranks.ToRanks(domain.candidates.row(i));
  }
  if (domain.feasible) {
    ranked.feasible = [ranks, feasible = domain.feasible](const Eigen::VectorXd& point) {
      return feasible(ranks.FromRanks(point));
    };
  }
  return ranked;
}

}  // namespace

RankedStrategy::RankedStrategy(const Domain& domain,
                               const std::function<std::unique_ptr<Strategy>(const Domain&)>& make)
    : domain_(domain), ranks_(domain.candidates), inner_(make(ByRanks(domain, ranks_))) {}

Eigen::VectorXd RankedStrategy::Candidate(const Eigen::VectorXd& ranks) const {
  return domain_.Snap(ranks_.FromRanks(ranks));
}

std::vector<Proposal> RankedStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  std::vector<Eigen::VectorXd> ranked;
  for (const Eigen::VectorXd& point : pending) ranked.push_back(ranks_.ToRanks(point));
  std::vector<Proposal> proposals = inner_->Ask(count, ranked);
  for (Proposal& proposal : proposals) proposal.point = Candidate(proposal.point);
  return proposals;
}

void RankedStrategy::Tell(const Observation& observation) {
  Observation ranked = observation;
  ranked.point = ranks_.ToRanks(observation.point);
  inner_->Tell(ranked);
}

Answer RankedStrategy::Recommend() {
  Answer answer = inner_->Recommend();
  answer.point = Candidate(answer.point);
  for (Eigen::VectorXd& tied : answer.tied) tied = Candidate(tied);
  Eigen::VectorXd low(answer.point.size());
  Eigen::VectorXd high(answer.point.size());
  for (std::size_t k = 0; k < answer.credible.size(); ++k) {
    low[static_cast<Eigen::Index>(k)] = answer.credible[k].low;
    high[static_cast<Eigen::Index>(k)] = answer.credible[k].high;
  }
  low = ranks_.FromRanks(low);
  high = ranks_.FromRanks(high);
  for (std::size_t k = 0; k < answer.credible.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    answer.credible[k] = {.low = low[i], .high = high[i]};
  }
  answer.warnings = BoundWarnings(answer.point);
  return answer;
}

}  // namespace talus::optimizer
