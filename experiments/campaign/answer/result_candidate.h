// A set that was simulated again with fresh seeds, and how it came out at each experiment.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"
#include "experiments/campaign/plan/candidates.h"

namespace talus::campaign {

inline double OrZero(double error) { return std::isfinite(error) ? error : 0; }  // where not known

// A number of an experiment, the mean over the confirming trials.
struct ResultScalar {
  std::string name{};
  int num_trials = 0;  // that have it
  double mean = base::kNotKnown;
  // The mean's, by the scatter within all confirmed sets; where each has one trial, by the model.
  double standard_error = base::kNotKnown;
  int degrees = 0;  // of freedom that the standard error has; 0: it is the model's, or not known
  std::optional<std::string> undefined{};  // why none of the trials has a value

  static constexpr base::FieldKey kKeys[] = {{"degrees", "degrees_of_freedom"}};
  TALUS_FIELDS(name, num_trials, mean, standard_error, degrees, undefined);
};

// How the confirming trials of one experiment came out.
struct ResultConfirmed {
  std::string name{};
  int num_trials = 0;                       // that succeeded
  double mean = base::kNotKnown;            // of the objective
  double standard_error = base::kNotKnown;  // of that mean; not known for one trial
  std::optional<double> sad_mm2{};          // mean SAD of the trials, whatever the objective
  // The mean's standard error and its degrees of freedom, as ResultScalar has them.
  std::optional<double> sad_standard_error{};
  int degrees = 0;
  std::optional<double> profile_sad_mm2{};    // SAD of their mean profile
  std::optional<double> over_floor{};         // … over the experiment's noise floor
  std::optional<double> profile_objective{};  // objective of their mean profile
  std::optional<double> spread_mm2{};  // mean SAD of each one's profile from that of the others
  std::vector<ResultScalar> scalars{};

  static constexpr base::FieldKey kKeys[] = {{"mean", "objective_mean"},
                                             {"standard_error", "objective_standard_error"},
                                             {"sad_standard_error", "sad_standard_error_mm2"},
                                             {"degrees", "sad_degrees_of_freedom"},
                                             {"profile_sad_mm2", "mean_profile_sad_mm2"},
                                             {"profile_objective", "mean_profile_objective"},
                                             {"over_floor", "mean_profile_sad_over_noise_floor"}};
  TALUS_FIELDS(name, num_trials, mean, standard_error, sad_mm2, sad_standard_error, degrees,
               profile_sad_mm2, profile_objective, over_floor, spread_mm2, scalars);
};

// A set that was simulated again with fresh seeds.
struct ResultCandidate {
  CandidateRole role = CandidateRole::kRecommended;
  std::vector<double> values{};  // in the order of the parameters, SI
  double scale_factor = 1;
  std::vector<ResultConfirmed> experiments{};  // in the campaign's order

  TALUS_FIELDS(role, values, scale_factor, experiments);
};

}  // namespace talus::campaign
