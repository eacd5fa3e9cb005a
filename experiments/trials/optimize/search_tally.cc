#include "experiments/trials/optimize/search_tally.h"

#include <algorithm>

#include "surrogate/same_point.h"

namespace talus::trials {

void SearchTally::Add(const optimizer::Observation& observation) {
  ++num_evaluations;
  if (observation.failed) {
    ++num_failed;
    return;
  }
  is_constant = is_constant && (!best || observation.value == best->value);
  if (!best || observation.value < best->value) {
    best = {.point = observation.point, .value = observation.value};
  }
  const auto first = std::ranges::find_if(firsts_, [&](const optimizer::Observation& o) {
    return surrogate::SamePoint(o.point, observation.point);
  });
  if (first == firsts_.end()) {
    firsts_.push_back({.point = observation.point, .value = observation.value});
    return;
  }
  ++num_repeats;
  num_equal_repeats += observation.value == first->value;
}

}  // namespace talus::trials
