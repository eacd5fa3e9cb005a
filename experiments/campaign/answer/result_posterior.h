// What the observations say of the parameters, as result.json holds it: the joint region and its
// branches, how well it is calibrated, and how the recommended set stands with each experiment.
#pragma once

#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"
#include "optimizer/posterior_summary.h"

namespace talus::campaign {

// A connected part of the joint 90 % region. Values in the order of the parameters, SI.
struct ResultBranch {
  double share = 0;  // of the posterior's draws in the region
  std::vector<double> values{};
  std::vector<double> low{};
  std::vector<double> high{};

  TALUS_FIELDS(share, values, low, high);
};

// A set beside an experiment, at the target scale factor.
using ResultStanding = optimizer::ExperimentStanding;

// What one experiment answers by itself. Values in the order of the parameters, SI.
struct ResultAlone {
  std::string name{};
  std::vector<double> values{};
  std::vector<double> low{};  // joint 90 % ranges
  std::vector<double> high{};

  TALUS_FIELDS(name, values, low, high);
};

struct ResultPosterior {
  double target_scale_factor = 1;
  bool is_extrapolated = false;          // no simulation at the target scale factor
  double region_volume = 1;              // of the joint 90 % region, share of the searched box
  std::vector<ResultBranch> branches{};  // the likeliest first
  double temper = 1;                     // misfits are divided by it, >= 1
  double raw_coverage = 0;               // of nominal 90 %, leave-one-out, before tempering
  double tempered_coverage = 0;          // … after it
  int num_left_out = 0;                  // trials that the two are made of
  std::vector<double> unlearnt_scale_factors{};  // scale factors whose bias is not known yet
  int fewest_at_finest = 0;  // simulations at the smallest one, of the experiment with the fewest
  // The largest share of its width that any number of simulations would take from a range [-].
  double surrogate_narrowing = 0;
  std::vector<ResultStanding> experiments;  // at the recommended set
  double tension = base::kNotKnown;  // between the experiments [standard deviations]: agreement.h
  std::string odd{};                 // the experiment with the largest part of it; "" without
  std::vector<ResultAlone> alone{};  // where experiments disagree only

  static constexpr base::FieldKey kKeys[] = {{"region_volume", "region_90_volume_fraction"},
                                             {"raw_coverage", "raw_coverage_90"},
                                             {"tempered_coverage", "tempered_coverage_90"}};
  TALUS_FIELDS(target_scale_factor, is_extrapolated, region_volume, branches, temper, raw_coverage,
               tempered_coverage, num_left_out, unlearnt_scale_factors, fewest_at_finest,
               surrogate_narrowing, experiments, tension, odd, alone);
};

// While the surrogate's variance is larger than all others: a range would be 1/√2 as wide without.
inline bool IsProvisional(double surrogate_narrowing) { return surrogate_narrowing > 0.29; }

// "provisional, since the surrogate …", without a full stop.
std::string ProvisionalText(double surrogate_narrowing);

}  // namespace talus::campaign
