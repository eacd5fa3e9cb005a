// An answer whose recommended set was simulated again, for tests of what is said of it.
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

}  // namespace talus::campaign
