// What is made of a trial when it has ended.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/folder/progress.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/journal/records.h"
#include "experiments/runners/runner.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::campaign {

// Ended from outside: says nothing of the parameters, and may go better next time.
bool WasEndedByOthers(const runners::FinishedJob& job);

// Counts one attempt's times among the trial's.
void AddTimes(const runners::FinishedJob& job, journal::TrialRecord& trial);

// "ended with exit status 1: last lines of its log"
std::string FailureText(const runners::FinishedJob& job, const std::filesystem::path& folder);

// Writes down what a trial that has ended well has left. Throws base::Error where its profile
// cannot be measured or a number has the name of an image's metric; the trial is as it was then.
void TakeOutput(const trials::TrialOutput& output, const Reference& reference,
                journal::TrialRecord& trial);

// A number that was measured and that the engine does not leave at all, in words; it is the
// set-up's fault, and no other trial would have it.
std::optional<std::string> MissingNumber(const Reference& reference,
                                         const std::vector<journal::MetricRecord>& left);

// All of it but whether it is the best so far.
TrialProgress ProgressOf(const journal::TrialRecord& trial, const journal::CampaignRecord& campaign,
                         const Reference& reference, journal::Objective objective);

}  // namespace talus::campaign
