#include "experiments/campaign/answer/representatives.h"

#include <optional>

#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/campaign/record/stored.h"

namespace talus::campaign {
namespace {

const ResultCandidate* Confirmed(const Answer& result, const Eigen::VectorXd& point) {
  for (const ResultCandidate& candidate : result.confirmed) {
    if (AreNear(UnitPoint(result, candidate.values), point)) return &candidate;
  }
  return nullptr;
}

bool Fits(const RepresentativeBasis& basis, const journal::TrialRecord& trial) {
  if (!trial.IsOfSearch() || trial.status != journal::TrialStatus::kOk) return false;
  if (trial.scale_factor != basis.finest) return false;
  const ResultCandidate* confirmed = Confirmed(basis.result, PointOf(trial));
  if (confirmed != nullptr && Misses(basis.result, *confirmed)) return false;
  const auto level = basis.planner.CredibleLevels(PointOf(trial).transpose());
  return level && (*level)[0] <= optimizer::kRegionLevel;
}

// Nothing where the search has simulated no set that stands for this end.
std::optional<Eigen::VectorXd> OfTheSearch(const RepresentativeBasis& basis,
                                           const Eigen::VectorXd& end) {
  Eigen::VectorXd nearest = basis.answer.point;
  for (const journal::TrialRecord& trial : basis.planner.trials()) {
    const Eigen::VectorXd point = PointOf(trial);
    if ((point - end).norm() < (nearest - end).norm() && Fits(basis, trial)) nearest = point;
  }
  if ((nearest - basis.answer.point).norm() <= (nearest - end).norm()) return std::nullopt;
  return nearest;
}

}  // namespace

std::vector<std::vector<double>> Representatives(const RepresentativeBasis& basis) {
  const auto& [answer, planner, result, finest] = basis;
  std::vector<std::vector<double>> sets;
  for (const Eigen::VectorXd& set : RepresentativeSets(planner.Region(*answer.posterior),
                                                       answer.point, planner.domain().Asked())) {
    if (set == answer.point) {
      sets.push_back(FreeValues(planner.space(), set));
    } else if (const ResultCandidate* confirmed = Confirmed(result, set)) {
      if (!Misses(result, *confirmed)) sets.push_back(confirmed->values);
    } else if (const auto simulated = OfTheSearch(basis, set)) {
      sets.push_back(FreeValues(planner.space(), *simulated));
    }
  }
  return sets;
}

}  // namespace talus::campaign
