// What one experiment has measured: the image of its heap, numbers with errors, or both.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "optimizer/outputs/field_objective.h"

namespace talus::optimizer {

// A number that was measured, in the unit that observations of it have.
struct ScalarTarget {
  std::string name;  // "mass_fallen_kg"
  double value = 0;
  double standard_error = 0;                              // of `value`, > 0
  double low = -std::numeric_limits<double>::infinity();  // it cannot be below, …
  double high = std::numeric_limits<double>::infinity();  // … nor above
};

struct ExperimentTarget {
  std::string name;
  FieldObjective image = {};                  // width 0: the experiment has no image
  std::vector<std::vector<float>> runs = {};  // images of its single heaps, as FieldObjective's
                                              // target; empty where only their mean is known
  std::vector<ScalarTarget> scalars = {};
  std::vector<double> costs = {};  // of one simulation [core seconds], one a scale
                                   // factor; estimates, until trials have been timed
  // Power of its likelihood, >= 0; anything but 1 misstates what is known. With 0 it is simulated
  // by design only, and predicted.
  double weight = 1;
};

}  // namespace talus::optimizer
