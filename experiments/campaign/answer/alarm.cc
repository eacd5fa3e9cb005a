#include "experiments/campaign/answer/alarm.h"

#include <cmath>

#include "base/text/counted.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/rigs/case/case_warnings.h"
#include "optimizer/search/describe_minimum.h"

namespace talus::campaign {
namespace {

std::string BudgetText(const Alarm& a) {
  return a.reason.value_or("") + " (" + ResumeCommand(a.value.value_or(kMoreSimulations)) + ")";
}

std::string Quoted(const std::optional<std::string>& name) {
  return "\"" + name.value_or("") + "\"";
}

// " mm²"; "" where it has none.
std::string UnitText(const Alarm& a) { return a.unit.value_or("").empty() ? "" : " " + *a.unit; }

// "0.68 mm² (noise floor 0.7), 0.08 mm² more than the model predicted"
std::string WorseThanPredictedText(const Alarm& a) {
  const std::string unit = UnitText(a);
  std::string text =
      "simulated again with fresh seeds, the mean heap of the recommended set misses " +
      Quoted(a.experiment) + " by " + base::PlainNumber(a.shown.value_or(0), 2) + unit;
  if (a.noise_floor) text += " (noise floor " + base::PlainNumber(*a.noise_floor, 2) + ")";
  return text + ", " + base::PlainNumber(a.value.value_or(0), 2) + unit +
         " more than the model predicted; more simulations round this set would settle it (" +
         ResumeCommand(kMoreSimulations) + ")";
}

// Coarse grains may miss what true ones would meet.
std::string FinerText(double scale_factor) {
  return ", and grains " + base::ShortNumber(scale_factor) +
         " times as large as yours may be what misses it: try a smaller scale factor";
}

// What may keep a set that fits away, the first in a list of suspects.
std::string PriorOf(const Alarm& a) {
  return a.parameter ? "the prior of " + *a.parameter + ", " : "";
}

MeasurementFit MeasurementOf(const Alarm& a) {
  return {.experiment = a.experiment.value_or(""), .number = a.number.value_or("")};
}

// "… misses the shape of "drum" by 5.1 times the noise floor, 11 % of the powder's area"
std::string MissesText(const Alarm& a) {
  std::string text = "the recommended set misses ";
  if (a.undefined) {
    text += SpokenOf(MeasurementOf(a)) + ": simulated with it there is none (" + *a.undefined + ")";
  } else if (a.number) {
    text += SpokenOf(MeasurementOf(a)) + " by " + base::PlainNumber(a.value.value_or(0), 2) +
            " standard errors";
  } else {
    text += SpokenOf(MeasurementOf(a)) + " by ";
    if (a.value) text += base::PlainNumber(*a.value, 2) + " times the noise floor";
    if (a.share) {
      text += (a.value ? ", " : "") + base::InPercent(*a.share) + " % of the powder's area";
    }
  }
  const std::string finer = a.scale_factor ? FinerText(*a.scale_factor) : "";
  if (a.kind == AlarmKind::kSearchMisses) {
    return text + ", and the search is not done: " + a.reason.value_or("") +
           "; simulate more before the contact law, the plate or the set-up is doubted for it (" +
           ResumeCommand(kMoreSimulations) + ")" + finer;
  }
  return text + ": nothing stands on this answer before " + PriorOf(a) +
         "the contact law, the plate and the set-up are checked" + finer;
}

}  // namespace

std::string ResumeCommand(double num_more) {
  return "`talus resume DIR --add-simulations " + std::to_string(std::llround(num_more)) + "`";
}

std::string AlarmText(const Alarm& a) {
  const std::string factor = "scale factor " + base::ShortNumber(a.scale_factor.value_or(1));
  const std::string experiment = Quoted(a.experiment);
  const std::string value = base::PlainNumber(a.value.value_or(0), 2);
  switch (a.kind) {
    case AlarmKind::kBound:
      return optimizer::BoundText(a.parameter.value_or(""), a.side == "upper");
    case AlarmKind::kFewGrains:
      return rigs::FewGrainsText(a.value.value_or(0), a.scale_factor.value_or(1),
                                 a.experiment.value_or(""));
    case AlarmKind::kImplausible:
      return "no set fits " + experiment + (a.reason ? " " + *a.reason : "") +
             ": the recommended one is " + value + " standard deviations off; " + PriorOf(a) +
             "the searched ranges, the contact law, the walls' material or the set-up is wrong" +
             // The model looks for one set: it may be the tests that contradict one another.
             (a.reason ? ", or the other tests rule out what fits it (`talus consider DIR --alone`)"
                       : "");
    case AlarmKind::kAllAlike:
      return "all " + base::ShortNumber(a.value.value_or(0)) + " simulations of " + experiment +
             " gave exactly the same, whatever was searched and whatever the seed: does the engine "
             "read them, or does the test tell nothing here?";
    case AlarmKind::kDisagree:
      return "the experiments disagree: each is met by sets that the others rule out (tension " +
             value + " standard deviations, " + experiment +
             " most); the contact law, the plate material or the set-up of one is wrong (`talus "
             "consider DIR --alone`)";
    case AlarmKind::kContradictsPrior:
      return "the measurements contradict the prior of " + a.parameter.value_or("") + " (" +
             a.reason.value_or("") + "): the posterior lies " +
             base::PlainNumber(std::abs(a.value.value_or(0)), 2) + " of its standard deviations " +
             (a.value.value_or(0) > 0 ? "above" : "below") +
             "; the prior, the contact law or the set-up is wrong";
    case AlarmKind::kExtrapolated:
      return "nothing was simulated at " + factor +
             ", which the answer is for: it is an extrapolation, and a few trials there would "
             "check it";
    case AlarmKind::kUnlearntScaleFactor:
      return "too few trials at " + factor +
             " tell its bias, and the ranges are wider for it; more simulations there would "
             "settle it (" +
             ResumeCommand(kMoreSimulations) + ")";
    case AlarmKind::kGoalMissed:
      return "the goal is not reached: " + a.reason.value_or("") +
             " (`talus next DIR --for CASE` ranks what would narrow it)";
    case AlarmKind::kFewSimulations:
      return experiment + " has only " + base::Counted(std::llround(*a.value), "simulation") +
             " at the smallest scale factor: so few are trusted less, and the joint "
             "region is wider for it; more would narrow it (" +
             ResumeCommand(kMoreSimulations) + ")";
    case AlarmKind::kWorseThanPredicted:
      return WorseThanPredictedText(a);
    case AlarmKind::kMisses:
    case AlarmKind::kSearchMisses:
      return MissesText(a);
    case AlarmKind::kConfirmationFailed:
      return "all " + base::Counted(std::lround(a.value.value_or(0)), "simulation") + " of " +
             experiment + " by the recommended set with fresh seeds failed (the last: " +
             base::OneLine(a.reason.value_or("")) +
             "): nothing stands on this answer before the cause is known";
    case AlarmKind::kWorseThanObserved:
      return "trial " + std::to_string(a.trial.value_or(0)) +
             " came out better than the recommended set, by " + value +
             (UnitText(a).empty() ? " of the objective" : UnitText(a)) +
             ": look at its set before you use this one";
    case AlarmKind::kBudgetEnded:
      return BudgetText(a);
    case AlarmKind::kCorrelated:
      return a.parameter.value_or("") + " and " + a.other_parameter.value_or("") +
             " are known together only (correlation " +
             base::ShortNumber(std::round(100 * a.value.value_or(0)) / 100) +
             "): use them as a pair; a different test may tell them apart (`talus next DIR`)";
    case AlarmKind::kPoorModel:
      return "the model is not sure of itself: of the simulations left out of the fit one by "
             "one, " +
             base::ShortNumber(std::round(100 * a.value.value_or(0))) +
             " % lay within its 90 % regions; the ranges are widened by " +
             base::PlainNumber(a.widened.value_or(1), 2) +
             " for it; more simulations would sharpen it (" + ResumeCommand(kMoreSimulations) + ")";
    default:  // a photograph's, in the words of its measurement, which name the photograph if any
      return (a.photo || !a.experiment ? "" : experiment + ": ") + a.reason.value_or("");
  }
}

Alarm PhotographAlarm(const journal::PhotoWarningRecord& warning, const std::string& experiment) {
  Alarm alarm{.experiment = experiment, .value = warning.value, .reason = warning.text};
  if (!warning.photo.empty()) alarm.photo = warning.photo;
  alarm.kind = base::EnumNamed<AlarmKind>(warning.kind).value_or(AlarmKind::kUnread);
  return alarm;
}

}  // namespace talus::campaign
