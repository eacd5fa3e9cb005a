// When a search or a session ends: it is noted, and stays so; what was found is written.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_writer.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/answer/conclude.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/remains.h"
#include "experiments/campaign/campaign.h"
#include "experiments/campaign/record/trial_end.h"
#include "experiments/journal/record_json.h"

namespace talus::campaign {

// A search that has ended stays so until something is asked of it (ReopenSearch). Its budget may
// have room again: trials that still ran when it ended counted by an estimate.
bool Campaign::StayEnded() {
  if (parts_.engine_is_new) return false;  // it had told nothing by the former one
  const journal::ProgressRecord before = journal_.Progress();
  stop_json_ = before.stop_json;
  if (!stop_json_.empty()) {
    planner_.StopSearch(journal::ParseRecord<Stop>(stop_json_, "the journal's stop"));
  }
  if (before.state != journal::CampaignState::kFinished || before.result_json.empty()) return false;
  planner_.StopSearch(ParseAnswer(before.result_json).stop);
  console_.Line("it has ended: " + before.stop_reason + "; `talus resume " +
                base::ShellWord(folder_.root.string()) + " --add-simulations " +
                std::to_string(kMoreSimulations) + "` goes on");
  return true;
}

// Trials that were under way are told after a rule has ended the search: asked anew, with these, it
// may answer otherwise. So may a budget of time, whose trials counted by an estimate, when the
// first confirmations, which are lost where the search goes on, have been planned.
void Campaign::NoteStop(const std::vector<journal::TrialRecord>& planned) {
  const std::optional<Stop>& stop = planner_.stop();
  if (!stop_json_.empty() || !stop || stop->kind == StopKind::kAllFailed) return;
  const bool confirms =
      std::ranges::count(planned, journal::TrialKind::kConfirm, &journal::TrialRecord::kind) > 0;
  if (stop->kind != StopKind::kRule && stop->kind != StopKind::kUndefined && !confirms) return;
  stop_json_ = base::JsonTextWriter::TextOf(*stop);
  NoteProgress();
  KeepProgress(folder_, ProgressSoFar());
}

KeptProgress Campaign::ProgressSoFar() const {
  const std::optional<Stop>& stop = planner_.stop();
  const bool has_ended = running_.empty() && waiting_.empty() && stop;
  return {.elapsed_s = Elapsed(),
          .num_of_search = static_cast<int>(
              std::ranges::count_if(planner_.trials(), &journal::TrialRecord::IsOfSearch)),
          .stop_json = has_ended && stop->kind != StopKind::kAllFailed
                           ? base::JsonTextWriter::TextOf(*stop)
                           : stop_json_};
}

// A result is that of the search as far as it had come: while this goes on there is none.
void Campaign::NoteProgress() {
  journal_.SetProgress({.elapsed_s = Elapsed(), .stop_json = stop_json_});
  std::error_code absent;
  for (const auto& former : {folder_.result(), folder_.posterior()}) {
    std::filesystem::remove(former, absent);
  }
}

void Campaign::DropRunning() {
  for (const auto& [id, trial] : running_) parts_.runner->Cancel(id);
  constexpr double kPollSeconds = 0.5;
  const auto until = Clock::now() + std::chrono::seconds(5);
  std::size_t left = running_.size();
  std::vector<journal::TrialRecord> stopped;
  while (left > 0 && Clock::now() < until) {
    for (const runners::FinishedJob& job : parts_.runner->Wait(kPollSeconds)) {
      --left;
      const auto found = running_.find(job.id);
      // One that has just ended well is adopted by the next session.
      if (found == running_.end() || job.ok()) continue;
      parts_.runner->Forget(JobOf(found->second));
      AddTimes(job, found->second);
      stopped.push_back(found->second);
    }
  }
  if (!stopped.empty()) journal_.Restart(stopped);
  running_.clear();
}

CampaignEnd Campaign::End(base::Interrupt interrupt) {
  // One that had ended before keeps its state and its result.
  const bool asked = interrupt != base::Interrupt::kNone;
  if (asked && journal_.Progress().state == journal::CampaignState::kFinished) {
    return CampaignEnd::kInterrupted;
  }
  for (const EndedTrial& ended : ended_) journal_.NoteEnd(ended.trial);
  const bool finished = interrupt == base::Interrupt::kNone && waiting_.empty();
  journal::ProgressRecord progress{
      .state = finished ? journal::CampaignState::kFinished : journal::CampaignState::kInterrupted,
      .stop_reason = finished ? planner_.stop()->Text() : "it was interrupted",
      .elapsed_s = Elapsed(),
      .result_json = {},
      .stop_json = stop_json_};
  if (finished) {
    const CampaignEvidence evidence{
        .spec = spec_,
        .campaign = record_,
        .references = references_,
        .profile = [this](std::int64_t id) { return StoredProfile(journal_, folder_, id); },
        .elapsed = Elapsed()};
    result_ = Conclude(planner_, evidence);
    if (result_) result_->remains = WriteRemains(folder_.root, planner_, evidence);
    if (result_) WriteResult(progress);
  }
  journal_.SetProgress(progress);
  KeepProgress(folder_, ProgressSoFar());
  journal_.AddEvent("stop", 0, progress.stop_reason);
  if (!finished) return CampaignEnd::kInterrupted;
  if (result_) return CampaignEnd::kFinished;
  console_.Line("no result: " + progress.stop_reason);
  return CampaignEnd::kFailed;
}

void Campaign::NoteError(const std::string& error) {
  console_.Note("an error ended it: " + error);
  try {
    // A campaign that had ended keeps its result, and the reason why it ended.
    if (journal_.Progress().state == journal::CampaignState::kFinished) return;
    journal_.SetProgress({.state = journal::CampaignState::kInterrupted,
                          .stop_reason = "an error ended it: " + error,
                          .elapsed_s = Elapsed(),
                          .result_json = {},
                          .stop_json = stop_json_});
  } catch (const base::Error&) {
    // A full disk, say, which is the error itself: the first is the one to be told.
  }
}

void Campaign::WriteResult(journal::ProgressRecord& progress) {
  progress.result_json = AnswerJson(*result_);
  base::WriteFileAtomically(folder_.result(), progress.result_json);
  const auto answer = planner_.Recommend();
  if (!answer || !answer->posterior) return;
  base::WriteFileAtomically(folder_.posterior(),
                            PosteriorCsv(*answer->posterior, planner_.space(), record_.parameters));
}

}  // namespace talus::campaign
