// What a campaign says in the end: the content of result.json, every number with its unit. Made
// once (conclude.h); terminal, card, report and Python read it.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "experiments/campaign/answer/alarm.h"
#include "experiments/campaign/answer/result_candidate.h"
#include "experiments/campaign/answer/result_held_out.h"
#include "experiments/campaign/answer/result_posterior.h"
#include "experiments/campaign/answer/result_prior.h"
#include "experiments/campaign/answer/result_reused.h"
#include "experiments/campaign/answer/verdict.h"
#include "experiments/campaign/plan/stop.h"
#include "optimizer/space/parameter_space.h"
#include "optimizer/stop_reason.h"

namespace talus::campaign {

// A searched parameter, SI; its unit stands beside it because it differs from one to the other.
struct ResultParameter {
  std::string name{};
  std::string unit{};
  double value = 0;
  double searched_low = 0;
  double searched_high = 0;
  optimizer::Scale scale = optimizer::Scale::kLinear;  // that it is searched on
  double credible_low = kNotKnown;  // 90 %, for all parameters asked for together; a nuisance's
                                    // by itself
  double credible_high = kNotKnown;
  double sobol_first = kNotKnown;
  double sobol_total = kNotKnown;
  std::optional<ResultPrior> prior{};        // none: uniform
  std::optional<ResultNuisance> nuisance{};  // none: it is asked for

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("unit", self.unit);
    visit("value", self.value);
    visit("searched_low", self.searched_low);
    visit("searched_high", self.searched_high);
    visit("scale", self.scale);
    visit("credible_90_low", self.credible_low);
    visit("credible_90_high", self.credible_high);
    visit("sobol_first", self.sobol_first);
    visit("sobol_total", self.sobol_total);
    visit("prior", self.prior);
    visit("nuisance", self.nuisance);
  }
  // Its searched range, for ToUnit and ToNative.
  optimizer::Parameter Range() const {
    return {.name = name, .low = searched_low, .high = searched_high, .scale = scale};
  }
  // The credible range's width as a share of what is searched, on the parameter's own scale.
  double Width() const { return Range().ToUnit(credible_high) - Range().ToUnit(credible_low); }
};

// A number as it was measured, in its metric's unit.
struct ResultNumber {
  std::string name{};
  double value = kNotKnown;
  double standard_error = kNotKnown;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("value", self.value);
    visit("standard_error", self.standard_error);
  }
};

// What was measured, and how far simulations of it scatter.
struct ResultExperiment {
  std::string name{};
  bool has_image = false;
  int num_heaps = 1;                    // that its image is the mean of
  std::optional<double> powder_area{};  // of its image [mm²]
  std::vector<ResultNumber> numbers{};
  std::optional<double> noise_floor{};    // SAD from run to run [mm²]; none for a map or numbers
  std::optional<double> noise_sd{};       // of the objective of one simulation, by the model
  std::optional<double> replicates_sd{};  // the same, from the replicates before the search

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("has_image", self.has_image);
    visit("num_heaps", self.num_heaps);
    visit("powder_area_mm2", self.powder_area);
    visit("numbers", self.numbers);
    visit("noise_floor_mm2", self.noise_floor);
    visit("noise_sd", self.noise_sd);
    visit("replicates_sd", self.replicates_sd);
  }
};

// What an experiment is made with.
struct ResultDevice {
  std::string experiment{};
  std::string text{};  // "drum: diameter 84 mm, speed 10 rpm"

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("experiment", self.experiment);
    visit("text", self.text);
  }
};

// A calibrated set, above all γ, holds only together with these.
struct ResultConditions {
  double scale_factor = 1;
  double surface_energy_exponent = 1;
  double youngs_modulus = 0;            // [Pa]
  std::vector<ResultDevice> devices{};  // of each experiment
  std::string adhesion{};
  std::string rolling{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("scale_factor", self.scale_factor);
    visit("surface_energy_exponent", self.surface_energy_exponent);
    visit("youngs_modulus_Pa", self.youngs_modulus);
    visit("devices", self.devices);
    visit("adhesion", self.adhesion);
    visit("rolling", self.rolling);
  }
};

// What more simulations are expected to take from the range of a parameter.
struct ResultNarrowing {
  std::string parameter{};
  double share = 0;  // of its width [-]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("parameter", self.parameter);
    visit("share", self.share);
  }
};

// The budget ended the search where more simulations would still narrow the ranges.
struct ResultUnsettled {
  optimizer::StopLack lacks = optimizer::StopLack::kGain;
  std::string why{};                         // the same, in words
  std::vector<ResultNarrowing> narrowing{};  // of each parameter asked for, where that is known
  int num_more = 0;                          // simulations that it is of; 0: not known

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("lacks", self.lacks);
    visit("why", self.why);
    visit("narrowing", self.narrowing);
    visit("more_simulations", self.num_more);
  }
};

// Without what was reused, which others have paid for.
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

struct Answer {
  std::string name{};
  std::string talus_version{};
  Stop stop{};
  std::optional<ResultUnsettled> unsettled{};
  std::string objective{};                 // key with the unit: "sad_mm2"
  std::string objective_unit{};            // for people: "mm²"
  std::optional<ResultVerdict> verdict{};  // what kind of answer it is
  // Sets to look at side by side, the recommended one among them, SI.
  std::vector<std::vector<double>> representative{};
  std::vector<ResultParameter> parameters{};
  std::vector<ResultExperiment> experiments{};
  std::vector<ResultCandidate> confirmed{};        // the recommended set first
  std::vector<std::vector<double>> correlation{};  // between the parameters
  std::string model{};
  std::optional<ResultPosterior> posterior{};  // none while there are too few trials
  std::optional<ResultHeldOut> held_out{};     // that the answer is made without
  std::vector<Alarm> warnings{};
  ResultConditions conditions{};
  ResultCost cost{};
  std::vector<ResultReused> reused{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name);
    visit("talus_version", self.talus_version);
    visit("stop", self.stop);
    visit("unsettled", self.unsettled);
    visit("objective", self.objective);
    visit("objective_unit", self.objective_unit);
    visit("verdict", self.verdict);
    visit("representative_sets", self.representative);
    visit("parameters", self.parameters);
    visit("experiments", self.experiments);
    visit("confirmed", self.confirmed);
    visit("correlation", self.correlation);
    visit("model", self.model);
    visit("posterior", self.posterior);
    visit("held_out", self.held_out);
    visit("warnings", self.warnings);
    visit("conditions", self.conditions);
    visit("cost", self.cost);
    visit("reused", self.reused);
  }
};

// result.json's text, and back.
std::string AnswerJson(const Answer& answer);
Answer ParseAnswer(const std::string& text);

// How the recommended set stands with an experiment by the model, and as confirmed; null where that
// is not known.
const ResultStanding* StandingOf(const Answer& answer, std::string_view experiment);
const ResultConfirmed* ConfirmedOf(const Answer& answer, std::string_view experiment);

// What the confirming trials of an experiment say that a model of mean heaps predicts: the SAD of
// their mean profile, of another objective the mean. NaN without either.
double ComparableOf(const Answer& answer, const ResultConfirmed& confirmed);

bool HasAlarm(const Answer& answer, std::initializer_list<AlarmKind> kinds);

// Whether an alarm wants more simulations before anything else is done.
bool AsksForSimulations(const Answer& answer);

// How many more there should be, where there should be some.
int MoreSimulations(const Answer& answer);

}  // namespace talus::campaign
