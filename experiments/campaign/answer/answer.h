// What a campaign says in the end: the content of result.json, every number with its unit. Made
// once (conclude.h); terminal, card, report and Python read it.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "base/not_known.h"
#include "experiments/campaign/answer/alarm.h"
#include "experiments/campaign/answer/result_candidate.h"
#include "experiments/campaign/answer/result_held_out.h"
#include "experiments/campaign/answer/result_posterior.h"
#include "experiments/campaign/answer/result_prior.h"
#include "experiments/campaign/answer/result_remains.h"
#include "experiments/campaign/answer/result_reused.h"
#include "experiments/campaign/answer/verdict.h"
#include "experiments/campaign/plan/stop.h"
#include "experiments/journal/records.h"
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
  double credible_low = base::kNotKnown;  // 90 %, for all parameters asked for together; a
                                          // nuisance's by itself
  double credible_high = base::kNotKnown;
  double sobol_first = base::kNotKnown;
  double sobol_total = base::kNotKnown;
  std::optional<ResultPrior> prior{};        // none: uniform
  std::optional<ResultNuisance> nuisance{};  // none: it is asked for

  static constexpr base::FieldKey kKeys[] = {{"credible_low", "credible_90_low"},
                                             {"credible_high", "credible_90_high"}};
  TALUS_FIELDS(name, unit, value, searched_low, searched_high, scale, credible_low, credible_high,
               sobol_first, sobol_total, prior, nuisance);
  // Its searched range, for ToUnit and ToNative.
  optimizer::Parameter Range() const {
    return {.name = name, .low = searched_low, .high = searched_high, .scale = scale};
  }
  // The credible range's width as a share of what is searched, on the parameter's own scale.
  double Width() const { return Range().ToUnit(credible_high) - Range().ToUnit(credible_low); }
};

// A number as it was measured, in its metric's unit.
using ResultNumber = journal::ScalarRecord;

// What was measured, and how far simulations of it scatter.
struct ResultExperiment {
  std::string name{};
  bool has_image = false;
  int num_heaps = 1;                    // that its image is the mean of
  std::optional<double> powder_area{};  // of its image [mm²]
  // Simulated views for each photograph that the image of one heap is the mean of; 1 of several
  // heaps, and where its grey levels do not tell. A picture of few views scatters more.
  double views_per_photograph = 1;
  std::vector<ResultNumber> numbers{};
  std::optional<double> noise_floor{};  // SAD from run to run [mm²]; none for a map or numbers
  std::optional<double> noise_sd{};     // of one simulation's objective at the target, by the model
  std::optional<double> replicates_sd{};  // of the replicates before the search, at their own

  static constexpr base::FieldKey kKeys[] = {{"powder_area", "powder_area_mm2"},
                                             {"noise_floor", "noise_floor_mm2"}};
  TALUS_FIELDS(name, has_image, num_heaps, powder_area, views_per_photograph, numbers, noise_floor,
               noise_sd, replicates_sd);
};

// What an experiment is made with.
struct ResultDevice {
  std::string experiment{};
  std::string text{};  // "drum: diameter 84 mm, speed 10 rpm"

  TALUS_FIELDS(experiment, text);
};

// A calibrated set, above all γ, holds only together with these.
struct ResultConditions {
  double scale_factor = 1;
  double surface_energy_exponent = 1;
  double youngs_modulus = 0;            // [Pa]
  std::vector<ResultDevice> devices{};  // of each experiment that it is from
  std::string adhesion{};
  std::string rolling{};
  std::string command{};  // of another engine, whose deck has the laws; empty: ours

  static constexpr base::FieldKey kKeys[] = {{"youngs_modulus", "youngs_modulus_Pa"},
                                             {"command", "engine_command"}};
  TALUS_FIELDS(scale_factor, surface_energy_exponent, youngs_modulus, devices, adhesion, rolling,
               command);
};

// What more simulations are expected to take from the range of a parameter.
struct ResultNarrowing {
  std::string parameter{};
  double share = 0;  // of its width [-]

  TALUS_FIELDS(parameter, share);
};

// The budget ended the search where more simulations would still narrow the ranges.
struct ResultUnsettled {
  optimizer::StopLack lacks = optimizer::StopLack::kGain;
  std::string why{};                         // the same, in words
  std::vector<ResultNarrowing> narrowing{};  // of each parameter asked for, where that is known
  int num_more = 0;                          // simulations that it is of; 0: not known

  static constexpr base::FieldKey kKeys[] = {{"num_more", "more_simulations"}};
  TALUS_FIELDS(lacks, why, narrowing, num_more);
};

// Without what was reused, which others have paid for.
struct ResultCost {
  int num_trials = 0;
  int num_failed = 0;
  double core_hours = 0;
  double elapsed = 0;  // [s], all sessions together

  static constexpr base::FieldKey kKeys[] = {{"elapsed", "elapsed_s"}};
  TALUS_FIELDS(num_trials, num_failed, core_hours, elapsed);
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
  std::vector<ResultCandidate> confirmed{};  // the recommended set first, if any of it succeeded
  std::vector<ResultRemains> remains{};      // maps at the recommended set
  std::vector<std::vector<double>> correlation{};  // between the parameters
  std::string model{};
  std::optional<ResultPosterior> posterior{};  // none while there are too few trials
  std::optional<ResultHeldOut> held_out{};     // that the answer is made without
  std::vector<Alarm> warnings{};
  ResultConditions conditions{};
  ResultCost cost{};
  std::vector<ResultReused> reused{};

  static constexpr base::FieldKey kKeys[] = {{"representative", "representative_sets"}};
  TALUS_FIELDS(name, talus_version, stop, unsettled, objective, objective_unit, verdict,
               representative, parameters, experiments, confirmed, remains, correlation, model,
               posterior, held_out, warnings, conditions, cost, reused);
};

// result.json's text, and back.
std::string AnswerJson(const Answer& answer);
Answer ParseAnswer(const std::string& text);

// How the recommended set stands with an experiment by the model, and as confirmed; null where that
// is not known.
const ResultStanding* StandingOf(const Answer& answer, std::string_view experiment);
const ResultCandidate* ConfirmedSet(const Answer& answer);
const ResultConfirmed* ConfirmedOf(const Answer& answer, std::string_view experiment);

// A set's point in the unit cube of the parameters, and that of the recommended one.
Eigen::VectorXd UnitPoint(const Answer& answer, const std::vector<double>& values);
Eigen::VectorXd RecommendedPoint(const Answer& answer);

// Whether it is the recommended set, to 1e-9 of a range: it may have been written as decimals. The
// campaign may have recommended others before, of fewer parameters.
bool IsRecommended(const Answer& answer, const std::vector<double>& values);

// Whether its objective is the SAD.
bool MinimisesSad(const Answer& answer);

bool HasAlarm(const Answer& answer, std::initializer_list<AlarmKind> kinds);

// No set fits, the tests disagree, or the recommended set misses or cannot be simulated: another
// set-up or more simulations come before anything is built on the answer.
bool IsDoubt(AlarmKind kind);
bool IsDoubtful(const Answer& answer);

// Whether an alarm wants more simulations before anything else is done.
bool AsksForSimulations(const Answer& answer);

// How many more there should be, where there should be some.
int MoreSimulations(const Answer& answer);

// "1.2, with the prediction's ± counted 4.8 times, as few simulations are at the smallest scale
// factor".
std::string ImplausibilityText(const ResultStanding& standing);

}  // namespace talus::campaign
