// What trials are ranked by: an objective of the heap's profile, or how far a number comes out from
// the one that the experiment has measured.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"
#include "experiments/journal/objective.h"

namespace talus::analysis {

struct Criterion {
  std::string key;           // "sad", "tapped_density_kg_per_m3"
  std::string metric;        // column of the trials that it is made of
  std::string title;         // as in a heading
  std::string unit;          // for people
  double per_unit = 1;       // number in `unit` / value of the metric
  bool is_distance = false;  // objective = |quantity - that of the experiment|
  bool is_sad = false;       // what the experiment's noise floor is of

  double Value(double quantity, double reference) const {
    return is_distance ? std::abs(quantity - reference) : quantity;
  }
};

Criterion CriterionOf(const journal::ObjectiveInfo& objective);

// Where the experiment has images each of kObjectives, in their order; then its numbers.
std::vector<Criterion> CriteriaOf(const Evidence& evidence);

// The campaign's own, of `evidence.objective`; the first number where there is no image.
std::size_t OwnCriterion(const Evidence& evidence, const std::vector<Criterion>& criteria);

}  // namespace talus::analysis
