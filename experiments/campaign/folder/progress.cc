#include "experiments/campaign/folder/progress.h"

#include "base/text/duration_text.h"
#include "base/text/number_text.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::campaign {

namespace {

// "1.2 mm², mass fallen 23 mg, the best so far"; of a test without images its numbers alone.
std::string OutcomeText(const TrialProgress& trial) {
  std::string text;
  if (trial.objective) text = base::ShortNumber(*trial.objective) + " " + trial.unit;
  for (const NumberProgress& number : trial.numbers) {
    text += (text.empty() ? "" : ", ") + rigs::SpokenName(number.name) + " " +
            rigs::ShownNumber(number.name, number.value);
  }
  if (text.empty()) return "what was measured is not defined of it";
  if (!trial.best) return text;
  return text + ", the best so far at the smallest scale factor";
}

}  // namespace

std::string ProgressText(const TrialProgress& trial) {
  std::string text =
      "trial " + std::to_string(trial.trial) + " (" + std::string(base::NameOf(trial.kind)) + ")";
  for (std::size_t i = 0; i < trial.values.size(); ++i) {
    text +=
        (i == 0 ? " at " : ", ") + trial.parameters[i] + " " + base::ShortNumber(trial.values[i]);
  }
  if (!trial.experiment.empty()) text += ", " + trial.experiment;
  text += " at scale factor " + base::ShortNumber(trial.scale_factor);
  if (trial.status == journal::TrialStatus::kFailed) {
    text += " failed: " + trial.reason;
  } else {
    text += ": " + OutcomeText(trial);
  }
  return text + ", " + base::DurationText(trial.duration);
}

std::string ProgressText(const CampaignProgress& campaign) {
  std::string text = campaign.used;
  if (campaign.num_confirm > 0) text += ", the search has ended and its sets are confirmed";
  text += ", " + std::to_string(campaign.num_running) + " running";
  if (campaign.num_waiting > 0) {
    text += ", " + std::to_string(campaign.num_waiting) + " waiting in the queue";
  }
  if (campaign.best) {
    text += ", best " + base::ShortNumber(*campaign.best) + " " + campaign.unit + " (trial " +
            std::to_string(campaign.best_trial) + ")";
  }
  if (campaign.seconds_left) {
    text += ", at most " + base::DurationText(*campaign.seconds_left) + " left";
  }
  return text;
}

}  // namespace talus::campaign
