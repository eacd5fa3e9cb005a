// How a search over several scale factors works.
#pragma once

#include <cstdint>
#include <vector>

namespace talus::optimizer {

struct PosteriorStrategyOptions {
  std::vector<double> scale_factors = {1};  // distinct, >= 1, in any order
  double target = 0;    // the scale factor that the answer is for, <= all of them; 0: the least
  int num_initial = 0;  // evaluations of the design at the coarsest level; 0: PosteriorDesignSize
  double model_error = 1;  // sd of what no simulation can match, in run-to-run sds of the images
  bool learn_model_error = false;  // model_error is the scale of its prior (learn_model_errors.h)
  double stop_share = 0.1;  // stop when no number of evaluations would take this share of its width
                            // from the range of a parameter that is asked for; 0: never
  std::uint64_t seed = 1;
};

}  // namespace talus::optimizer
