#include "optimizer/strategy/design_strategy.h"

#include <algorithm>

#include "optimizer/search/history.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

Points Inside(const Domain& domain, const Points& points) {
  Points inside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(inside),
               [&](const Eigen::VectorXd& point) { return domain.Contains(point); });
  return inside;
}

}  // namespace

DesignStrategy::DesignStrategy(const Domain& domain, const Points& points, std::string name)
    : domain_(domain), queue_(domain, points), name_(std::move(name)) {}

void DesignStrategy::Append(const Points& points) {
  for (const Eigen::VectorXd& point : points) {
    const bool is_told = std::any_of(told_.begin(), told_.end(), [&](const Observation& seen) {
      return surrogate::SamePoint(seen.point, point);
    });
    queue_.Append(point, is_told);
  }
}

void DesignStrategy::Tell(const Observation& observation) {
  queue_.MarkEvaluated(observation.point);
  told_.push_back(WithoutImage(observation));
}

std::vector<Proposal> DesignStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  Points asked(pending.begin(), pending.end());
  std::vector<Proposal> proposals;
  while (static_cast<int>(proposals.size()) < count) {
    const auto point = queue_.Next(asked);
    if (!point) break;
    proposals.push_back({*point, Origin::kDesign});
    asked.push_back(*point);
  }
  return proposals;
}

std::optional<StopReason> DesignStrategy::WhyStop() {
  if (!IsDone()) return std::nullopt;
  return StopReason{
      .rule = StopRule::kAllEvaluated, .value = static_cast<double>(queue_.size()), .name = name_};
}

Answer DesignStrategy::Recommend() { return BestObserved(told_, domain_, name_); }

GridStrategy::GridStrategy(const Domain& domain, const Sweep& sweep)
    : DesignStrategy(domain, FullFactorial(sweep.levels), "the grid"),
      sweep_(sweep),
      grid_(Inside(domain, FullFactorial(sweep.levels))) {}

// While the last points of the sweep run, nobody knows yet which ones are best.
void GridStrategy::Tell(const Observation& observation) {
  DesignStrategy::Tell(observation);
  if (is_refined_ || !IsDone()) return;
  const Points refinement = Refinement();
  num_refined_ = refinement.size();
  Append(refinement);
  is_refined_ = true;
}

Points GridStrategy::Refinement() const {
  std::vector<const Observation*> best;
  for (const Observation& observation : told()) {
    const bool on_grid = std::any_of(grid_.begin(), grid_.end(), [&](const Eigen::VectorXd& p) {
      return surrogate::SamePoint(p, observation.point);
    });
    if (on_grid && !observation.failed) best.push_back(&observation);
  }
  std::stable_sort(best.begin(), best.end(),
                   [](const Observation* a, const Observation* b) { return a->value < b->value; });
  const auto num_best = std::min(best.size(), static_cast<std::size_t>(sweep_.refine_best));
  Points centers;
  for (std::size_t i = 0; i < num_best; ++i) centers.push_back(best[i]->point);
  return Inside(domain_, HalfStepNeighbours(sweep_.levels, centers));
}

std::optional<StopReason> GridStrategy::WhyStop() {
  if (!IsDone()) return std::nullopt;
  return StopReason{.rule = StopRule::kGridEvaluated,
                    .value = static_cast<double>(grid_.size()),
                    .limit = static_cast<double>(num_refined_)};
}

}  // namespace talus::optimizer
