// A campaign without simulations: heaps drawn from a formula of three parameters, with scatter from
// seed to seed and some failures, compared with the heap of a known set by the real metrics.
#pragma once

#include "experiments/analysis/compare/evidence.h"

namespace talus::test {

struct SyntheticOptions {
  int num_trials = 60;
  int num_parameters = 3;      // 2 or 3: without the third, cohesion is that of the truth
  int every_failed = 13;       // each so-manieth trial fails
  bool concluded = true;       // else it is still running and there is no answer
  bool coarse_design = false;  // at scale factor 2, the rest at 1; else all at 1
  bool much_to_say = false;    // more alarms and devices than a sheet of paper has room for
};

// The set that the reference heap is drawn with: μ_t, μ_r and γ, SI.
std::vector<double> SyntheticTruth();

analysis::Evidence MakeSyntheticCampaign(const SyntheticOptions& options = {});

}  // namespace talus::test
