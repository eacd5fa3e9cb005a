#include "experiments/campaign/answer/result_warning.h"

#include <cmath>

#include "base/text/number_text.h"
#include "experiments/rigs/lifted_tube/heap_scene.h"
#include "optimizer/answer/answer.h"

namespace talus::campaign {
namespace {

// "`talus resume DIR --add-simulations 20`"
std::string ResumeCommand(double num_more) {
  return "`talus resume DIR --add-simulations " + std::to_string(std::llround(num_more)) + "`";
}

std::string BudgetText(const ResultWarning& w) {
  const std::string remedy = w.value ? "about " + std::to_string(std::llround(*w.value)) +
                                           " more simulations would meet it"
                                     : "go on with more simulations";
  return "the budget ended the search before its stopping rule did: " + w.text + "; " + remedy +
         " (" + ResumeCommand(w.value.value_or(kMoreSimulations)) + ")";
}

std::string TextOf(const ResultWarning& w) {
  const std::string factor = "scale factor " + base::ShortNumber(w.scale_factor.value_or(1));
  const std::string experiment = "\"" + w.experiment.value_or("") + "\"";
  const std::string value = base::ShortNumber(w.value.value_or(0));
  switch (w.kind) {
    case WarningKind::kBound:
      return optimizer::BoundText(w.parameter.value_or(""), w.side == "upper");
    case WarningKind::kFewGrains:
      return rigs::FewGrainsText(w.value.value_or(0), w.scale_factor.value_or(1),
                                 w.experiment.value_or(""));
    case WarningKind::kImplausible:
      return "no set fits " + experiment + ": the recommended one is " + value +
             " standard deviations off; the contact law, the plate material or the set-up is wrong";
    case WarningKind::kDisagree:
      return "the experiments disagree: each is met by sets that the others rule out (tension " +
             value + " standard deviations, " + experiment +
             " most); the contact law, the plate material or the set-up of one is wrong (`talus "
             "consider DIR --alone`)";
    case WarningKind::kExtrapolated:
      return "nothing was simulated at " + factor +
             ", which the answer is for: it is an extrapolation, and a few trials there would "
             "check it";
    case WarningKind::kUnlearntScaleFactor:
      return "too few trials at " + factor +
             " tell its bias, and the ranges are wider for it; more simulations there would "
             "settle it (" +
             ResumeCommand(kMoreSimulations) + ")";
    case WarningKind::kFewSimulations:
      return "an experiment has only " + value +
             " simulations at the smallest scale factor: so few are trusted less, and the joint "
             "region is wider for it; more would narrow it (" +
             ResumeCommand(kMoreSimulations) + ")";
    case WarningKind::kNotModelsChoice:
      return "the set that the model recommends was confirmed worse than another candidate, which "
             "is recommended instead; the predicted value is that of the model's set";
    case WarningKind::kWorseThanPredicted:
      return "confirmed worse than predicted: " + w.text +
             "; more simulations round this set would settle it (" +
             ResumeCommand(kMoreSimulations) + ")";
    case WarningKind::kWorseThanObserved:
      return "trial " + std::to_string(w.trial.value_or(0)) +
             " came out better than the recommended set, by " + value +
             " of the objective: look at its set before you use this one";
    case WarningKind::kBudgetEnded:
      return BudgetText(w);
    case WarningKind::kCorrelated:
      return w.parameter.value_or("") + " and " + w.other_parameter.value_or("") +
             " are known together only (correlation " +
             base::ShortNumber(std::round(100 * w.value.value_or(0)) / 100) +
             "): use them as a pair, or measure one of them in another test";
    case WarningKind::kPoorModel:
      return "the model is not sure of itself: " + w.text +
             "; more simulations would sharpen it (" + ResumeCommand(kMoreSimulations) + ")";
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
