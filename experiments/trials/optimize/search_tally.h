// What was told of a search, counted.
#pragma once

#include <optional>
#include <vector>

#include "optimizer/observation.h"

namespace talus::trials {

struct SearchTally {
  int num_evaluations = 0;
  int num_failed = 0;
  std::optional<optimizer::Observation> best;  // of the lowest value
  int num_repeats = 0;                         // of a set that had succeeded before
  int num_equal_repeats = 0;                   // whose value was the first one's to the last bit
  bool is_constant = true;                     // all values are one

  void Add(const optimizer::Observation& observation);

 private:
  std::vector<optimizer::Observation> firsts_;  // of each set that has succeeded
};

}  // namespace talus::trials
