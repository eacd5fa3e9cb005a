// What result.json says of a parameter's prior, and of one that is searched but not asked for.
#pragma once

#include <string>

#include "base/field.h"
#include "base/not_known.h"

namespace talus::campaign {

// What was known of a parameter beforehand, SI.
struct ResultPrior {
  std::string text{};  // as the spec gives it: "0.35 ± 0.05"
  // Its 90 % range inside the searched one, of the same kind as the answer's: those of all
  // parameters that are asked for hold 90 % together.
  double low = base::kNotKnown;
  double high = base::kNotKnown;
  double offset = 0;  // of the posterior's mean from its, in its standard deviations

  static constexpr base::FieldKey kKeys[] = {
      {"low", "low_90"}, {"high", "high_90"}, {"offset", "offset_sd"}};
  TALUS_FIELDS(text, low, high, offset);
};

// What a parameter that is not asked for does to those that are.
struct ResultNuisance {
  double narrowing =
      0;  // the share by which a range would shrink if it were known: sample_statistics.h
  std::string of_range{};  // the parameter of that range, the one that would shrink most

  TALUS_FIELDS(narrowing, of_range);
};

}  // namespace talus::campaign
