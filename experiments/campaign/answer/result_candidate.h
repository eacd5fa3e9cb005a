// A set that was simulated again with fresh seeds, and how it came out at each experiment.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "experiments/campaign/plan/candidates.h"

namespace talus::campaign {

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// A number of an experiment, the mean over the confirming trials.
struct ResultScalar {
  std::string name{};
  double mean = kNotKnown;
  double standard_error = kNotKnown;  // of that mean; not known for one trial

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("mean", self.mean);
    visit("standard_error", self.standard_error);
  }
};

// How the confirming trials of one experiment came out.
struct ResultConfirmed {
  std::string name{};
  int num_trials = 0;                       // that succeeded
  double mean = kNotKnown;                  // of the objective
  double standard_error = kNotKnown;        // of that mean; not known for one trial
  std::optional<double> sad_mm2{};          // mean SAD of the trials, whatever the objective
  std::optional<double> profile_sad_mm2{};  // SAD of their mean profile
  std::optional<double> over_floor{};       // … over the experiment's noise floor
  std::vector<ResultScalar> scalars{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("num_trials", self.num_trials);
    visit("objective_mean", self.mean);
    visit("objective_standard_error", self.standard_error);
    visit("sad_mm2", self.sad_mm2);
    visit("mean_profile_sad_mm2", self.profile_sad_mm2);
    visit("mean_profile_sad_over_noise_floor", self.over_floor);
    visit("scalars", self.scalars);
  }
};

// A set that was simulated again with fresh seeds.
struct ResultCandidate {
  CandidateRole role = CandidateRole::kRecommended;
  std::vector<double> values{};  // in the order of the parameters, SI
  double scale_factor = 1;
  std::vector<ResultConfirmed> experiments{};  // in the campaign's order

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("role", self.role);
    visit("values", self.values);
    visit("scale_factor", self.scale_factor);
    visit("experiments", self.experiments);
  }
};

}  // namespace talus::campaign
