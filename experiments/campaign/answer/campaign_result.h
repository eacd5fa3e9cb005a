// What a campaign says in the end: the content of result.json, every number with its unit.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "experiments/campaign/answer/result_held_out.h"
#include "experiments/campaign/answer/result_posterior.h"
#include "experiments/campaign/answer/result_warning.h"
#include "experiments/campaign/verdict.h"

namespace talus::campaign {

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// A calibrated parameter, SI; its unit stands beside it because it differs from one to the other.
struct ResultParameter {
  std::string name;
  std::string unit;
  double value = 0;
  double credible_low = kNotKnown;  // 90 %, for all parameters together
  double credible_high = kNotKnown;
  double sobol_first = kNotKnown;
  double sobol_total = kNotKnown;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("unit", self.unit);
    visit("value", self.value);
    visit("credible_90_low", self.credible_low);
    visit("credible_90_high", self.credible_high);
    visit("sobol_first", self.sobol_first);
    visit("sobol_total", self.sobol_total);
  }
};

// A number that an experiment has measured, and the mean of the confirming trials.
struct ResultScalar {
  std::string name;
  double mean = kNotKnown;
  double measured = kNotKnown;
  double measured_sd = kNotKnown;  // standard error

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("mean", self.mean);
    visit("measured", self.measured);
    visit("measured_sd", self.measured_sd);
  }
};

// How the confirming trials of one experiment came out.
struct ResultConfirmed {
  std::string name;
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

// A set that was simulated again with fresh seeds. The numbers beside the list are of the first
// experiment.
struct ResultCandidate {
  std::vector<double> values{};  // in the order of the parameters, SI
  double scale_factor = 1;
  int num_trials = 0;                       // that succeeded
  double mean = kNotKnown;                  // of the objective
  double standard_error = kNotKnown;        // of that mean; not known for one trial
  std::optional<double> sad_mm2{};          // mean SAD of the trials, whatever the objective
  std::optional<double> profile_sad_mm2{};  // SAD of their mean profile
  std::optional<std::vector<ResultConfirmed>> experiments{};  // with several, or with numbers

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("values", self.values);
    visit("scale_factor", self.scale_factor);
    visit("num_trials", self.num_trials);
    visit("objective_mean", self.mean);
    visit("objective_standard_error", self.standard_error);
    visit("sad_mm2", self.sad_mm2);
    visit("mean_profile_sad_mm2", self.profile_sad_mm2);
    visit("experiments", self.experiments);
  }
};

// A calibrated set, above all γ, holds only together with these.
struct ResultConditions {
  double scale_factor = 1;
  double surface_energy_exponent = 1;
  double youngs_modulus = 0;  // [Pa]
  double lift_velocity = 0;   // [m/s]
  std::string adhesion;
  std::string rolling;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("scale_factor", self.scale_factor);
    visit("surface_energy_exponent", self.surface_energy_exponent);
    visit("youngs_modulus_Pa", self.youngs_modulus);
    visit("lift_velocity_m_per_s", self.lift_velocity);
    visit("adhesion", self.adhesion);
    visit("rolling", self.rolling);
  }
};

// The budget ended the search before its stopping rule did.
struct ResultUnsettled {
  std::string why{};            // what the rule lacks
  double share = kNotKnown;     // surrogate's variance / what the measurements leave open [-]
  double num_more = kNotKnown;  // simulations that would settle it, an estimate

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("why", self.why);
    visit("surrogate_variance_share", self.share);
    visit("more_simulations", self.num_more);
  }
};

struct ResultCost {
  int num_trials = 0;
  int num_failed = 0;
  double core_hours = 0;
  double elapsed = 0;  // [s], all sessions together

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("num_trials", self.num_trials);
    visit("num_failed", self.num_failed);
    visit("core_hours", self.core_hours);
    visit("elapsed_s", self.elapsed);
  }
};

struct CampaignResult {
  std::string name;
  std::string talus_version;
  std::string stop_reason;
  std::optional<ResultUnsettled> unsettled{};
  std::string objective;                   // key with the unit: "sad_mm2"
  std::string objective_unit;              // for people: "mm²"
  std::optional<ResultVerdict> verdict{};  // what kind of answer it is
  // Sets to look at side by side, the recommended one among them, SI.
  std::vector<std::vector<double>> representative{};
  std::vector<ResultParameter> parameters{};
  double predicted = kNotKnown;              // objective at the recommended set
  double predicted_sd = kNotKnown;           // of that mean
  double noise_sd = kNotKnown;               // scatter of one simulation, by the model
  std::optional<double> replicates_sd{};     // the same, from the replicates before the search
  std::vector<ResultCandidate> confirmed{};  // the recommended set first
  std::optional<double> noise_floor{};       // of the experiment: SAD [mm²]
  // SAD of the confirming trials' mean profile / noise floor [-]
  std::optional<double> confirmed_over_floor{};
  double tied_volume = kNotKnown;                  // share of the searched box [-]
  std::vector<std::vector<double>> tied{};         // sets that tie, SI
  std::vector<std::vector<double>> correlation{};  // between the parameters
  std::string model;
  std::optional<ResultPosterior> posterior{};  // of several scale factors or experiments
  std::optional<ResultHeldOut> held_out{};     // that the answer is made without
  std::vector<ResultWarning> warnings{};
  ResultConditions conditions;
  ResultCost cost;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("talus_version", self.talus_version);
    visit("stop_reason", self.stop_reason);
    visit("unsettled", self.unsettled);
    visit("objective", self.objective);
    visit("objective_unit", self.objective_unit);
    visit("verdict", self.verdict);
    visit("representative_sets", self.representative);
    visit("parameters", self.parameters);
    visit("predicted_objective", self.predicted);
    visit("predicted_objective_sd", self.predicted_sd);
    visit("noise_sd", self.noise_sd);
    visit("replicates_sd", self.replicates_sd);
    visit("confirmed", self.confirmed);
    visit("experimental_noise_floor_mm2", self.noise_floor);
    visit("confirmed_profile_sad_over_noise_floor", self.confirmed_over_floor);
    visit("tied_volume_fraction", self.tied_volume);
    visit("tied_sets", self.tied);
    visit("correlation", self.correlation);
    visit("model", self.model);
    visit("posterior", self.posterior);
    visit("held_out", self.held_out);
    visit("warnings", self.warnings);
    visit("conditions", self.conditions);
    visit("cost", self.cost);
  }
};

// result.json's text, and back (for the report).
std::string ResultText(const CampaignResult& result);
CampaignResult ParseResult(const std::string& text);

// The same for people, in some twenty lines; commands in it are for the campaign in `folder`.
std::string ResultSummary(const CampaignResult& result, const std::filesystem::path& folder);

}  // namespace talus::campaign
