// Answers by hand, for tests of what is said of them: of a set that was simulated again, and of two
// parameters.
#pragma once

#include "experiments/campaign/answer/answer.h"

namespace talus::campaign {

// Predicted 4 ± 0.1 where one simulation scatters by 0.3.
inline Answer ConfirmedAt(double mean) {
  Answer answer;
  answer.objective = "sad_mm2";
  answer.experiments = {{.name = "heap", .has_image = true, .noise_sd = 0.3}};
  answer.posterior.emplace().experiments = {{.name = "heap", .predicted = 4, .predicted_sd = 0.1}};
  answer.confirmed = {{.scale_factor = 1,
                       .experiments = {{.name = "heap",
                                        .num_trials = 3,
                                        .mean = mean,
                                        .standard_error = 0.2,
                                        .sad_mm2 = mean}}}};
  return answer;
}

inline ResultConfirmed& HeapOf(Answer& answer) { return answer.confirmed[0].experiments[0]; }

// Sliding friction from 0 to 1 and surface energy from 1 µJ/m² to 100 µJ/m², logarithmic.
inline Answer ResultWithSet(double sliding, double energy) {
  Answer answer;
  answer.parameters = {
      {.name = "sliding_friction", .value = sliding, .searched_low = 0, .searched_high = 1},
      {.name = "surface_energy",
       .unit = "J/m²",
       .value = energy,
       .searched_low = 1e-6,
       .searched_high = 1e-4,
       .scale = optimizer::Scale::kLog}};
  return answer;
}

}  // namespace talus::campaign
