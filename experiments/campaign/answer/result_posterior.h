// What the observations say of the parameters, as result.json holds it: the joint region and its
// branches, how well it is calibrated, and how the recommended set stands with each experiment.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/field.h"

namespace talus::campaign {

// A connected part of the joint 90 % region. Values in the order of the parameters, SI.
struct ResultBranch {
  double share = 0;  // of the posterior's draws in the region
  std::vector<double> values{};
  std::vector<double> low{};
  std::vector<double> high{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("share", self.share);
    visit("values", self.values);
    visit("low", self.low);
    visit("high", self.high);
  }
};

// A number of an experiment at a set, as the model expects it: in the order of the experiment's.
struct ResultPredictedNumber {
  double predicted = 0;     // mean over seeds, in the metric's unit
  double predicted_sd = 0;  // of that mean

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("predicted", self.predicted);
    visit("predicted_sd", self.predicted_sd);
  }
};

// A set beside an experiment, at the target scale factor.
struct ResultStanding {
  std::string name{};
  double predicted = std::numeric_limits<double>::quiet_NaN();     // objective; NaN without images
  double predicted_sd = std::numeric_limits<double>::quiet_NaN();  // of that mean
  double implausibility = 0;                                       // [standard deviations]
  double model_error = 1;       // that the posterior counts with, in run-to-run sds [-]
  double model_error_told = 0;  // share of its prior's sd that was learnt, in [0, 1]; 0: stated
  std::vector<ResultPredictedNumber> numbers{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("predicted_objective", self.predicted);
    visit("predicted_objective_sd", self.predicted_sd);
    visit("implausibility", self.implausibility);
    visit("model_error", self.model_error);
    visit("model_error_told", self.model_error_told);
    visit("numbers", self.numbers);
  }
};

// What one experiment answers by itself. Values in the order of the parameters, SI.
struct ResultAlone {
  std::string name{};
  std::vector<double> values{};
  std::vector<double> low{};  // joint 90 % ranges
  std::vector<double> high{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("values", self.values);
    visit("low", self.low);
    visit("high", self.high);
  }
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
  double tension = 0;                // between the experiments [standard deviations]: agreement.h
  std::string odd{};                 // the experiment with the largest part of it; "" without
  std::vector<ResultAlone> alone{};  // where experiments disagree only

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("target_scale_factor", self.target_scale_factor);
    visit("is_extrapolated", self.is_extrapolated);
    visit("region_90_volume_fraction", self.region_volume);
    visit("branches", self.branches);
    visit("temper", self.temper);
    visit("raw_coverage_90", self.raw_coverage);
    visit("tempered_coverage_90", self.tempered_coverage);
    visit("num_left_out", self.num_left_out);
    visit("unlearnt_scale_factors", self.unlearnt_scale_factors);
    visit("fewest_at_finest", self.fewest_at_finest);
    visit("surrogate_narrowing", self.surrogate_narrowing);
    visit("experiments", self.experiments);
    visit("tension", self.tension);
    visit("odd", self.odd);
    visit("alone", self.alone);
  }
};

// While the surrogate's variance is larger than all others: a range would be 1/√2 as wide without.
inline bool IsProvisional(double surrogate_narrowing) { return surrogate_narrowing > 0.29; }

// "provisional, since the surrogate …", without a full stop.
std::string ProvisionalText(double surrogate_narrowing);

}  // namespace talus::campaign
