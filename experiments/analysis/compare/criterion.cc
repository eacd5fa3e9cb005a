#include "experiments/analysis/compare/criterion.h"

#include "experiments/analysis/compare/labels.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::analysis {

Criterion CriterionOf(const journal::ObjectiveInfo& objective) {
  return {.key = std::string(objective.key),
          .metric = std::string(objective.metric),
          .title = std::string(objective.title),
          .unit = std::string(objective.unit),
          .is_distance = objective.is_angle,
          .is_sad = objective.objective == journal::Objective::kSad};
}

std::vector<Criterion> CriteriaOf(const Evidence& evidence) {
  std::vector<Criterion> criteria;
  if (evidence.reference.has_image()) {
    for (const journal::ObjectiveInfo& objective : journal::kObjectives)
      criteria.push_back(CriterionOf(objective));
  }
  for (const journal::ScalarRecord& number : evidence.reference.numbers) {
    const ShownUnit unit = ShownUnitOf(rigs::UnitOfObservable(number.name));
    criteria.push_back({.key = number.name,
                        .metric = number.name,
                        .title = MetricTitle(number.name),
                        .unit = unit.text,
                        .per_unit = unit.per_unit,
                        .is_distance = true});
  }
  return criteria;
}

std::size_t OwnCriterion(const Evidence& evidence, const std::vector<Criterion>& criteria) {
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    if (criteria[i].key == evidence.objective) return i;
  }
  return 0;
}

}  // namespace talus::analysis
