#include "experiments/analysis/compare/criterion.h"

#include <algorithm>

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
  const auto is_taken = [&](const std::string& title) {
    return std::ranges::count(criteria, title, &Criterion::title) > 0;
  };
  for (const journal::ScalarRecord& number : evidence.reference.numbers) {
    const std::string title = MetricTitle(number.name);
    const ShownUnit unit = ShownUnitOf(rigs::UnitOfObservable(number.name));
    criteria.push_back({.key = number.name,
                        .metric = number.name,
                        // An angle of repose may be one of the image, and measured, too.
                        .title = is_taken(title) ? title + " (measured)" : title,
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
