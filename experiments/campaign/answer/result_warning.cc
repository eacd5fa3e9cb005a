#include "experiments/campaign/answer/result_warning.h"

#include <cmath>

#include "base/text/number_text.h"
#include "optimizer/answer/answer.h"

namespace talus::campaign {
namespace {

std::string TextOf(const ResultWarning& w) {
  const std::string factor = "scale factor " + base::ShortNumber(w.scale_factor.value_or(1));
  const std::string experiment = "\"" + w.experiment.value_or("") + "\"";
  const std::string value = base::ShortNumber(w.value.value_or(0));
  switch (w.kind) {
    case WarningKind::kBound:
      return optimizer::BoundText(w.parameter.value_or(""), w.side == "upper");
    case WarningKind::kFewGrains:
      return "only " + value + " grains across the plate of " + experiment + " at " + factor +
             "; 30 or more are advised";
    case WarningKind::kImplausible:
      return "no set fits " + experiment + ": the recommended one is " + value +
             " standard deviations off; the contact law, the plate material or the set-up is wrong";
    case WarningKind::kExtrapolated:
      return "nothing was simulated at " + factor +
             ", which the answer is for: it is an extrapolation, and a few trials there would "
             "check it";
    case WarningKind::kUnlearntScaleFactor:
      return "too few trials at " + factor +
             " tell its bias, and the ranges are wider for it; more simulations there would "
             "settle it (`talus resume DIR --add-simulations N`)";
    case WarningKind::kNotModelsChoice:
      return "the set that the model recommends was confirmed worse than another candidate, which "
             "is recommended instead; the predicted value is that of the model's set";
    case WarningKind::kWorseThanPredicted:
      return "confirmed worse than predicted, by " + value +
             " of the objective: the model promises too much here; more simulations round this set "
             "would settle it (`talus resume DIR --add-simulations N`)";
    case WarningKind::kWorseThanObserved:
      return "trial " + std::to_string(w.trial.value_or(0)) +
             " came out better than the recommended set, by " + value +
             " of the objective: look at its set before you use this one";
    case WarningKind::kCorrelated:
      return w.parameter.value_or("") + " and " + w.other_parameter.value_or("") +
             " are known together only (correlation " +
             base::ShortNumber(std::round(100 * w.value.value_or(0)) / 100) +
             "): use them as a pair, or measure one of them in another test";
    case WarningKind::kPoorModel:
      return "the model predicts badly what it was not told: " + w.text;
    default:  // a photograph's, or an earlier version's: in words already
      return w.text;
  }
  return w.text;
}

}  // namespace

ResultWarning PhotographWarning(const journal::PhotoWarningRecord& warning,
                                const std::string& experiment) {
  ResultWarning made{.experiment = experiment, .value = warning.value, .text = warning.text};
  if (!warning.photo.empty()) made.photo = warning.photo;
  for (const auto& [name, kind] : base::Names<WarningKind>::kList) {
    if (name == warning.kind) made.kind = kind;
  }
  return made;
}

ResultWarning Worded(ResultWarning warning) {
  warning.text = TextOf(warning);
  return warning;
}

}  // namespace talus::campaign
