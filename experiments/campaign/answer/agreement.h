// Whether the experiments of a campaign can be met by one set: the parameter goodness of fit
// [maltoni2003]. From the trials there are; nothing is simulated.
//
//   Χ² = min Σ_e S_e - Σ_e min S_e,   Σ_e min(d, K_e) - d degrees of freedom
//
// S_e is an experiment's sum of squared residuals over the temper at a set, looked at over draws of
// the joint posterior and of each alone, K_e the number of its outputs (modes of its image, and
// numbers) and d that of parameters which the data move
// (optimizer/posterior/sample_statistics.h). Tests of fewer outputs than that meet themselves
// somewhere, and tell only what is over; where that is less than half a degree there is no tension.
// Each test may fit well enough where it stands and still pull elsewhere: two misfits that are no
// surprise by themselves can be one together.
#pragma once

#include <string>
#include <vector>

#include "base/not_known.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::campaign {

struct Agreement {
  std::vector<PartialAnswer> alone{};  // of each experiment that has enough trials
  double tension = base::kNotKnown;    // Tension of Χ²
  std::string odd{};  // the experiment with the largest part of Χ²; "" without tension
};

// The agreement of the experiments that the campaign's answer meets.
Agreement AgreementOf(const JointView& view);

// Standard deviations of a normal variable as unlikely as a chi-squared one of so many degrees of
// freedom, by Wilson and Hilferty's cube root; 0 where it is smaller than usual, not known of less
// than half a degree.
double Tension(double chi_squared, double freedom);

// Whether the tension is an alarm. Surrogates that miss most of their own trials (`raw_coverage` of
// nominal 90 %, leave-one-out) cannot tell; the answer warns of them.
bool Disagree(double tension, double raw_coverage);

}  // namespace talus::campaign
