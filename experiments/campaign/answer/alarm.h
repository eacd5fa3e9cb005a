// What a user should know before trusting a result: facts as data, put in words in one place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/field.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// Those of photographs have the names that measure.json gives them (imaging::PhotoDoubt).
// The gravest first: alarms stand in this order.
enum class AlarmKind {
  kImplausible,  // no set fits `experiment`: the best is `value` standard deviations off; the prior
                 // of `parameter`, where there is one, may keep it away
  kDisagree,     // the experiments pull apart by `value`, `experiment` most
  kAllAlike,     // all `value` simulations of `experiment` gave the same
  kMisses,       // the recommended set misses `experiment`'s image by `value` noise floors and
                 // `share` of its powder's area, or its `number` by `value` standard errors, or
                 // has none, as `undefined` says; `scale_factor`, where grains are coarser than
                 // true ones; `parameter` as above
  kSearchMisses,         // the same, but another set may fit, for `reason`: the search is to blame
  kConfirmationFailed,   // all `value` simulations of `experiment` by the recommended set with
                         // fresh seeds failed, the last for `reason`
  kContradictsPrior,     // the posterior of `parameter` is `value` sd off its prior, `reason`
  kWorseThanPredicted,   // `shown` is worse than predicted, by `value` of the objective
  kWorseThanObserved,    // … than trial `trial` at the same `scale_factor`, by `value`
  kPoorModel,            // a share `value` of the trials left out lay in their 90 % regions
  kExtrapolated,         // nothing was simulated at the target `scale_factor`
  kUnlearntScaleFactor,  // the bias of `scale_factor` is not known
  kBudgetEnded,          // the budget ended the search before its stopping rule did, for
                         // `reason`; about `value` simulations more
  kGoalMissed,           // the search ended without what the spec's goal asks for: `reason`
  kFewSimulations,       // `value` at the smallest scale factor: the region may be too small
  kCorrelated,           // `parameter` and `other_parameter` are known together only: `value`
  kBound,                // `parameter` of the recommended set lies on its `side`
  kFewGrains,            // `value` grains across the plate of `experiment` at `scale_factor`
  kMoreThanFilled,       // from here on the words are those of who measured the photographs: they
                         // show a heap of `value` times the mass filled in
  kLeftOut,              // photographs of `experiment` were left out, one or all
  kUnread,
  kSeveralHeaps,
  kRunDisagrees,
  kNoNoise,
  kFrontLit,
  kMixedLight,
  kHiddenTop,
  kTilted,
  kBeyondPicture,
  kNoPowder,
  kTouchesFrame,
  kBesidePlate,
  kViewDisagrees,
  kOverexposed,
  kOtherLight,
  kCopied
};
constexpr AlarmKind LastOf(AlarmKind) { return AlarmKind::kCopied; }

struct Alarm;

// In words. Commands in it name the campaign's folder DIR (folder_in_text.h).
std::string AlarmText(const Alarm& alarm);

struct Alarm {
  AlarmKind kind = AlarmKind::kImplausible;
  std::optional<std::string> parameter{};
  std::optional<std::string> other_parameter{};
  std::optional<std::string> side{};  // "lower" or "upper"
  std::optional<std::string> experiment{};
  std::optional<double> scale_factor{};
  std::optional<std::int64_t> trial{};
  std::optional<std::string> photo{};   // file
  std::optional<std::string> number{};  // name of its metric
  std::optional<std::string> unit{};    // of the objective, for people
  std::optional<double> value{};
  std::optional<double> share{};
  std::optional<double> shown{};           // objective of the recommended set's mean heap
  std::optional<double> noise_floor{};     // of the experiment [mm²]
  std::optional<double> widened{};         // factor on the ranges
  std::optional<std::string> undefined{};  // why a simulation has no such number
  std::optional<std::string> reason{};  // in the words of who found it: the rule, the photographs

  static constexpr base::FieldKey kKeys[] = {{"noise_floor", "noise_floor_mm2"}};
  TALUS_FIELD_LIST(kind, parameter, other_parameter, side, experiment, scale_factor, trial, photo,
                   number, unit, value, share, shown, noise_floor, widened, undefined, reason);

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    VisitFields(self, visit);
    std::string text = AlarmText(self);  // for people; made anew wherever it is read
    visit("text", text);
  }
};

inline constexpr int kMoreSimulations = 20;  // to go on with where no better number is known

// "`talus resume DIR --add-simulations 20`".
std::string ResumeCommand(double num_more);

// What was doubted of an experiment's photographs, under the name that it has there.
Alarm PhotographAlarm(const journal::PhotoWarningRecord& warning, const std::string& experiment);

}  // namespace talus::campaign
