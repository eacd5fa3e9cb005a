#include "optimizer/design_strategy.h"

#include <algorithm>

#include "optimizer/best_observed.h"

namespace talus::optimizer {
namespace {

Points Inside(const Domain& domain, const Points& points) {
  Points inside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(inside),
               [&](const Eigen::VectorXd& point) { return domain.Contains(point); });
  return inside;
}

Points WithGuesses(const Domain& domain, const Points& points) {
  Points all = domain.guesses;
  for (const Eigen::VectorXd& point : Inside(domain, points)) all.push_back(point);
  return all;
}

}  // namespace

DesignStrategy::DesignStrategy(const Domain& domain, const Points& points, std::string name)
    : domain_(domain),
      points_(WithGuesses(domain, points)),
      name_(std::move(name)),
      is_told_(points_.size(), false) {}

void DesignStrategy::Tell(const Observation& observation) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_told_[i]) is_told_[i] = SamePoint(points_[i], observation.point);
  }
  told_.push_back(observation);
}

bool DesignStrategy::WasTold(const Eigen::VectorXd& point) const {
  return std::any_of(told_.begin(), told_.end(),
                     [&](const Observation& o) { return SamePoint(o.point, point); });
}

std::vector<Proposal> DesignStrategy::Next(const Points& points, int count,
                                           std::span<const Eigen::VectorXd> pending) const {
  std::vector<Proposal> proposals;
  for (const Eigen::VectorXd& point : points) {
    if (static_cast<int>(proposals.size()) >= count) break;
    const bool runs = std::any_of(pending.begin(), pending.end(),
                                  [&](const Eigen::VectorXd& p) { return SamePoint(p, point); });
    if (!runs && !WasTold(point)) proposals.push_back({point, Origin::kDesign});
  }
  return proposals;
}

std::vector<Proposal> DesignStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  Points left;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_told_[i]) left.push_back(points_[i]);
  }
  return Next(left, count, pending);
}

std::optional<std::string> DesignStrategy::StopReason() {
  if (std::find(is_told_.begin(), is_told_.end(), false) != is_told_.end()) return std::nullopt;
  return "all " + std::to_string(points_.size()) + " points of " + name_ + " are evaluated";
}

Answer DesignStrategy::Recommend() { return BestObserved(told_, domain_, name_); }

GridStrategy::GridStrategy(const Domain& domain, const Sweep& sweep)
    : DesignStrategy(domain, FullFactorial(sweep.levels), "the grid"),
      sweep_(sweep),
      grid_(Inside(domain, FullFactorial(sweep.levels))) {}

bool GridStrategy::SweepIsDone() const {
  return std::all_of(grid_.begin(), grid_.end(),
                     [&](const Eigen::VectorXd& point) { return WasTold(point); });
}

Points GridStrategy::Refinement() const {
  std::vector<const Observation*> best;
  for (const Observation& observation : told()) {
    const bool on_grid = std::any_of(grid_.begin(), grid_.end(), [&](const Eigen::VectorXd& p) {
      return SamePoint(p, observation.point);
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

std::vector<Proposal> GridStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  // While the last points of the sweep run, nobody knows yet which ones are best.
  if (!SweepIsDone()) return DesignStrategy::Ask(count, pending);
  return Next(Refinement(), count, pending);
}

std::optional<std::string> GridStrategy::StopReason() {
  if (!SweepIsDone()) return std::nullopt;
  const Points refinement = Refinement();
  if (!std::all_of(refinement.begin(), refinement.end(),
                   [&](const Eigen::VectorXd& point) { return WasTold(point); })) {
    return std::nullopt;
  }
  return "all " + std::to_string(grid_.size()) + " points of the grid and " +
         std::to_string(refinement.size()) + " half-step neighbours of its best are evaluated";
}

}  // namespace talus::optimizer
