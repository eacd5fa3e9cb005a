// The calibration loop: ask → write case → run → measure → journal → tell.
//
// The journal is the state. Whatever ends the process, what OpenCampaign gives goes on from it;
// what was running is run again, or collected where it has ended meanwhile.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/interrupt.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/folder/console.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/campaign/plan/goal_judge.h"
#include "experiments/campaign/plan/planner.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/journal.h"
#include "experiments/runners/runner.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::campaign {

// What a campaign works with, so that tests can put others in their place.
struct CampaignParts {
  std::unique_ptr<runners::Runner> runner;
  std::unique_ptr<trials::TrialEngine> engine;
  std::unique_ptr<GoalJudge> goal{};  // of a spec with a goal
  // Whether the engine has been mended since the last session: all that was begun is run again.
  bool engine_is_new = false;
};

enum class CampaignEnd { kFinished, kInterrupted, kFailed };

class Campaign {
 public:
  // Goes on with the journal in `folder`, whose spec is `spec`; see start.h for how both come to
  // be.
  Campaign(CampaignFolder folder, CampaignLock lock, journal::Journal journal,
           const CampaignSpec& spec, CampaignParts parts, Console& console);

  // Until the budget is used, the strategy says stop, or somebody interrupts. Throws base::Error
  // when the journal or the folder cannot be written; the running trials are then run again by the
  // next process.
  CampaignEnd Run(const base::InterruptGuard& interrupt);

  const std::optional<Answer>& result() const { return result_; }

 private:
  using Clock = std::chrono::steady_clock;

  struct EndedTrial {
    journal::TrialRecord trial;
    std::optional<imaging::GrayImage> profile;  // of one that succeeded, where it leaves one
  };

  CampaignEnd GoOn(const base::InterruptGuard& interrupt);
  bool StayEnded();
  KeptProgress ProgressSoFar() const;
  void RunFailedAgain();
  void RunFromTheBeginning(const std::vector<journal::TrialRecord>& trials,
                           const std::string& which, const std::string& of = "");
  void ForgetJob(const journal::TrialRecord& trial);
  void TellFinished();
  void TakeUpRunning();
  void NoteFormerEngineGone();
  void CollectReused();
  // Begun and not told.
  std::size_t NumBegun() const { return running_.size() + waiting_.size() + ended_.size(); }
  int RoomToBegin() const;
  bool MayTell(base::Interrupt asked) const;
  bool StartTrials(const base::InterruptGuard& interrupt);
  bool SubmitWaiting();
  void Begin(std::vector<journal::TrialRecord> planned);
  void NoteFormerGoal();
  bool IsGoalDue() const;
  bool LookAtGoal(const base::InterruptGuard& interrupt);  // false where the user ends it
  void Submit(const std::vector<journal::TrialRecord>& trials);
  runners::Job JobOf(const journal::TrialRecord& trial) const;
  rigs::Case CaseOf(const journal::TrialRecord& trial) const {
    return CaseOfTrial(spec_, trial, ReferenceOf(trial).frame());
  }
  void HandleEnd(const runners::FinishedJob& job);
  bool RunAgain(journal::TrialRecord& trial, const std::string& reason);
  void Collect(journal::TrialRecord& trial);
  void SayDoubt(const journal::TrialRecord& trial, const std::string& doubt);
  void FailOrRetry(journal::TrialRecord& trial, const std::string& reason);
  void Keep(journal::TrialRecord& trial, std::optional<imaging::GrayImage> profile);
  bool TellEnded();
  void Tell(EndedTrial& ended);
  // Not with every trial: it waits for the disk.
  void NoteElapsed(std::chrono::seconds period = std::chrono::seconds(2));
  void NoteStop(const std::vector<journal::TrialRecord>& planned);
  void NoteProgress();
  void DropRunning();
  CampaignEnd End(base::Interrupt interrupt);
  void NoteError(const std::string& error);
  void WriteResult(journal::ProgressRecord& progress);
  void NoteBest(const journal::TrialRecord& trial);
  void Report(const journal::TrialRecord& trial);
  void ShowStatus();
  void ShowTrouble();
  double Elapsed() const;  // [s], all sessions
  const Reference& ReferenceOf(const journal::TrialRecord& trial) const {
    return references_[static_cast<std::size_t>(trial.experiment)];
  }

  CampaignFolder folder_;
  CampaignLock lock_;
  journal::Journal journal_;
  CampaignSpec spec_;
  journal::CampaignRecord record_;
  std::vector<Reference> references_;  // of the experiments
  Planner planner_;
  CampaignParts parts_;
  Console& console_;
  std::map<std::int64_t, journal::TrialRecord> running_;
  std::deque<journal::TrialRecord> waiting_;             // to be run, when there is room
  std::vector<EndedTrial> ended_;                        // to be told, in their turn
  std::map<std::int64_t, int> reruns_;                   // of trials that others have ended
  std::set<std::int64_t> stale_;                         // running, by an engine that was mended
  bool has_doubted_ = false;                             // the set-up, in this session
  std::string trouble_;                                  // of the queue, as last told
  std::optional<std::pair<double, std::int64_t>> best_;  // value and trial
  std::optional<Answer> result_;
  Clock::time_point start_;
  std::string stop_json_;      // of the rule that has ended the search; empty where none has
  Clock::time_point noted_;    // when the time worked on it was last written
  double elapsed_before_ = 0;  // [s]
};

}  // namespace talus::campaign
