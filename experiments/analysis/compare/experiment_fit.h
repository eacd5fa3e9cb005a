// How well the recommended set meets each experiment, for people who did not run the campaign.
#pragma once

#include <string>
#include <vector>

#include "base/not_known.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/journal/records.h"

namespace talus::analysis {

// One thing that was measured beside what the recommended set gives of it.
struct FitRow {
  std::string experiment{};
  std::string what{};       // "shape", "mass fallen"
  std::string measured{};   // "5 runs, each 0.68 mm² SAD from the mean of the others"
  std::string simulated{};  // "0.446 mm² SAD", "5.51 mg"; empty where nothing was simulated there
  std::string judgement{};  // "0.66 times as far as the runs are from each other"
  campaign::Meets meets = campaign::Meets::kUnknown;
  double implausibility = base::kNotKnown;  // of the experiment
  std::string confirmed{};                  // the confirming part of `simulated`
  bool is_confirmed = false;                // simulated again with fresh seeds
  bool held_out = false;                    // the answer is made without it
  bool few_measured = false;                // what leaves it open is the measurement
};

// Every experiment's image and numbers, in the campaign's order: as confirmed with fresh seeds, or
// as the model predicts where nothing was confirmed.
std::vector<FitRow> FitRows(const campaign::Answer& result, const journal::CampaignRecord& record);

// The rows in a sentence: which experiments are met and which are not; empty without rows.
std::string FitSentence(const std::vector<FitRow>& rows);

}  // namespace talus::analysis
