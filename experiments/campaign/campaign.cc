#include "experiments/campaign/campaign.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/not_known.h"
#include "base/text/counted.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/campaign/plan/budget_use.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/campaign/plan/turns.h"
#include "experiments/campaign/record/trial_end.h"
#include "experiments/campaign/spec/deck_gaps.h"
#include "experiments/campaign/start.h"
#include "imaging/formats/images/image_file.h"

namespace talus::campaign {
namespace {

constexpr double kWaitSeconds = 0.5;  // between two looks at the keyboard and the clock

[[noreturn]] void StopForDisk(const journal::TrialRecord& trial, const std::string& reason) {
  throw base::Unwritten("trial " + std::to_string(trial.id) + ": " + reason);
}

// `is_settled`: trials have succeeded with the deck, so that it can no more be mended.
[[noreturn]] void StopForNumber(const journal::TrialRecord& trial, const std::string& missing,
                                bool is_settled) {
  throw base::Error("trial " + std::to_string(trial.id) + " " + missing +
                    (is_settled ? ". Let the engine leave it under this name "
                                  "(docs/foreign_engines.md) in another campaign: trials have "
                                  "succeeded with this one's deck"
                                : ". Let the engine leave it under this name "
                                  "(docs/foreign_engines.md) and `talus resume`"));
}

}  // namespace

Campaign::Campaign(CampaignFolder folder, CampaignLock lock, journal::Journal journal,
                   const CampaignSpec& spec, CampaignParts parts, Console& console)
    : folder_(std::move(folder)),
      lock_(std::move(lock)),
      journal_(std::move(journal)),
      spec_(spec),
      record_(journal_.Campaign()),
      references_(ReferencesOf(record_, spec_)),
      planner_(spec_, record_, references_),
      parts_(std::move(parts)),
      console_(console),
      start_(Clock::now()),
      elapsed_before_(journal_.Progress().elapsed_s) {}

double Campaign::Elapsed() const {
  return elapsed_before_ + std::chrono::duration<double>(Clock::now() - start_).count();
}

CampaignEnd Campaign::Run(const base::InterruptGuard& interrupt) {
  try {
    return GoOn(interrupt);
  } catch (const base::Interrupted&) {
    throw;
  } catch (const base::Error& error) {  // `talus status` is asked later, and elsewhere
    NoteError(error.what());
    throw;
  }
}

CampaignEnd Campaign::GoOn(const base::InterruptGuard& interrupt) {
  if (!StayEnded()) {
    NoteProgress();
    RunFailedAgain();
  }
  TellFinished();
  NoteFormerGoal();
  TakeUpRunning();
  CollectReused();
  if (const auto warning = CoresWarning(spec_, NumCores())) console_.Line("warning: " + *warning);
  for (const std::string& warning : DeckWarnings(spec_)) console_.Line("warning: " + warning);
  bool announced = false;
  while (true) {
    const base::Interrupt asked = interrupt.Asked();
    if (asked == base::Interrupt::kDrop) {
      DropRunning();
      return End(asked);
    }
    const bool started = asked == base::Interrupt::kNone && StartTrials(interrupt);
    if (MayTell(asked) && TellEnded()) continue;  // what follows is planned before more is told
    if (asked == base::Interrupt::kDrain && !std::exchange(announced, true)) {
      for (const std::int64_t id : parts_.runner->TakeBackUnsent()) running_.erase(id);
      console_.Line("ends after " + base::Counted(std::ssize(running_), "running trial") +
                    "; press Ctrl-C again to drop them");
    }
    if (running_.empty() && started) continue;  // they had ended in an earlier process
    if (running_.empty()) return End(asked);
    ShowStatus();
    for (const runners::FinishedJob& job : parts_.runner->Wait(kWaitSeconds)) HandleEnd(job);
    NoteElapsed(std::chrono::minutes(1));  // trials of hours: a reboot is not to forget them
  }
}

// What let its runs fail may have been mended.
void Campaign::NoteFormerGoal() {
  std::optional<GoalState> goal = LastGoal(folder_.root, spec_);
  if (goal) goal->failure.clear();
  planner_.NoteGoal(std::move(goal));
  planner_.NoteGoalTime(GoalCoreTime(folder_.root, spec_));
}

// Once the search is past its first design, after 16, 24, 36, … trials have ended.
bool Campaign::IsGoalDue() const {
  if (!parts_.goal || planner_.stop()) return false;
  if (planner_.goal() && !planner_.goal()->failure.empty()) return false;
  std::int64_t ended = 0;
  bool searches = false;
  for (const journal::TrialRecord& trial : planner_.trials()) {
    ended += trial.IsOfSearch() && trial.status != journal::TrialStatus::kRunning;
    searches |= trial.kind == journal::TrialKind::kSearch;
  }
  return searches && ended >= NextLook(planner_.goal(), spec_);
}

bool Campaign::LookAtGoal(const base::InterruptGuard& interrupt) {
  const auto ended = std::ranges::count_if(planner_.trials(), &journal::TrialRecord::IsOfSearch);
  const auto state = parts_.goal->Look(ended, interrupt);
  NoteElapsed();
  if (!state) return false;
  planner_.NoteGoal(state);
  const std::string text = TextOf(*state, *spec_.goal);
  journal_.AddEvent("goal", 0, text);
  console_.Line("goal: " + text);
  return true;
}

// After Ctrl-C nothing is planned: a trial that is told leaves room for one that is planned on
// resuming, when no more may be known than in an unbroken campaign.
bool Campaign::MayTell(base::Interrupt asked) const {
  return asked == base::Interrupt::kNone || !AreToldInTurn(spec_) || RoomToBegin() <= 0;
}

int Campaign::RoomToBegin() const {
  return MostBegun(spec_, parts_.runner->Capacity()) - static_cast<int>(NumBegun());
}

bool Campaign::StartTrials(const base::InterruptGuard& interrupt) {
  if (spec_.budget.wall_clock && Elapsed() > *spec_.budget.wall_clock) {
    planner_.StopSearch({.kind = StopKind::kWallClock, .value = *spec_.budget.wall_clock});
  }
  const bool submitted = SubmitWaiting();  // before the proposals, which take their time
  const int room = RoomToBegin();
  if (room <= 0) return submitted;
  if (IsGoalDue()) {
    if (NumBegun() > 0) return submitted;
    if (!LookAtGoal(interrupt)) return true;  // it is to end
  }
  std::vector<journal::TrialRecord> planned = planner_.Next(room);
  NoteStop(planned);
  Begin(std::move(planned));
  return SubmitWaiting() || submitted;
}

// Those due first: the others may end before their turn.
bool Campaign::SubmitWaiting() {
  std::ranges::stable_sort(waiting_, {}, &journal::TrialRecord::due);
  std::vector<journal::TrialRecord> trials;
  const int room = parts_.runner->Capacity() - static_cast<int>(running_.size());
  while (!waiting_.empty() && static_cast<int>(trials.size()) < room) {
    trials.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }
  if (!trials.empty()) Submit(trials);
  return !trials.empty();
}

void Campaign::Begin(std::vector<journal::TrialRecord> planned) {
  if (planned.empty()) return;
  for (journal::TrialRecord& trial : planned) trial.started_utc = journal::UtcNow();
  journal_.Start(planned, parts_.runner->JobsOutliveUs() ? base::Outlives::kPowerCut
                                                         : base::Outlives::kProgram);
  for (const journal::TrialRecord& trial : planned) {
    planner_.Started(trial);
    KeepTrial(folder_, trial);
  }
  std::ranges::move(planned, std::back_inserter(waiting_));
}

// A trial whose folder holds its result already, because the process ended before it could be
// journalled, is not run twice.
void Campaign::Submit(const std::vector<journal::TrialRecord>& trials) {
  std::vector<runners::Job> jobs;
  std::vector<runners::FinishedJob> ended;
  for (const journal::TrialRecord& trial : trials) {
    runners::Job job = JobOf(trial);
    parts_.engine->Prepare(CaseOf(trial), job.folder);
    KeepTrial(folder_, trial);
    running_[trial.id] = trial;
    if (parts_.engine->IsComplete(job.folder)) {
      ended.push_back({.id = trial.id,
                       .end = runners::JobEnd::kExit,
                       .exit_status = 0,
                       .reason = {},
                       .duration = base::kNotKnown,
                       .cpu_time = 0,
                       .host = {}});
      continue;
    }
    job.command = parts_.engine->Command(job.folder);
    jobs.push_back(std::move(job));
  }
  if (!jobs.empty()) {
    const std::vector<std::string> names = parts_.runner->Submit(jobs);
    std::vector<journal::TrialRecord> renamed;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      journal::TrialRecord& trial = running_[jobs[i].id];
      if (std::exchange(trial.job, names[i]) != names[i]) renamed.push_back(trial);
    }
    if (!renamed.empty()) journal_.Restart(renamed);
  }
  for (const runners::FinishedJob& job : ended) HandleEnd(job);
}

runners::Job Campaign::JobOf(const journal::TrialRecord& trial) const {
  const auto reruns = reruns_.find(trial.id);
  return {.id = trial.id,
          .attempt = trial.attempts + (reruns == reruns_.end() ? 0 : reruns->second),
          .folder = folder_.trial(trial.id),
          .command = {},
          .time_cap = spec_.trial_time_cap};
}

void Campaign::HandleEnd(const runners::FinishedJob& job) {
  const auto found = running_.find(job.id);
  if (found == running_.end()) return;
  journal::TrialRecord trial = std::move(found->second);
  running_.erase(found);
  if (stale_.erase(trial.id) > 0) {  // however it has ended, it was the former engine's
    parts_.runner->Forget(JobOf(trial));
    ++reruns_[trial.id];
    waiting_.push_back(std::move(trial));
    NoteFormerEngineGone();
    return;
  }
  AddTimes(job, trial);  // to those of its earlier attempts
  if (!job.host.empty()) trial.host = job.host;
  if (job.end == runners::JobEnd::kNotStarted) {  // the set-up's fault: every other would fail
    throw base::Error("trial " + std::to_string(trial.id) +
                      " could not be started: " + FailureText(job, folder_.trial(trial.id)) +
                      "; mend this, and `talus resume` goes on with the same trial");
  }
  if (WasEndedByOthers(job) && RunAgain(trial, job.reason)) return;
  // An earlier process has refused its result and not recorded that: the disk was full, or a number
  // was missing. A queue still reports that it has ended well.
  const bool was_refused = job.ok() && !parts_.engine->IsComplete(folder_.trial(trial.id));
  if (was_refused && RunAgain(trial, "had left a result that was refused")) return;
  if (job.ok()) {
    Collect(trial);
  } else {
    FailOrRetry(trial, FailureText(job, folder_.trial(trial.id)));
  }
}

void Campaign::Collect(journal::TrialRecord& trial) {
  trials::TrialOutput output;
  try {
    output = parts_.engine->Collect(CaseOf(trial), folder_.trial(trial.id));
    TakeOutput(output, ReferenceOf(trial), trial);
  } catch (const base::Unwritten& error) {
    StopForDisk(trial, error.what());
  } catch (const base::Error& error) {
    FailOrRetry(trial, error.what());
    return;
  }
  SayDoubt(trial, output.doubt);
  if (const auto missing = MissingNumber(ReferenceOf(trial), output.scalars)) {
    const bool any = std::ranges::count(planner_.trials(), journal::TrialStatus::kOk,
                                        &journal::TrialRecord::status) > 0;
    // Who resumes may have mended the program: what it has left for the others does not count, too.
    parts_.engine->Forget(folder_.trial(trial.id));
    for (const auto& [id, other] : running_) parts_.engine->Forget(folder_.trial(id));
    for (const auto& other : waiting_) parts_.engine->Forget(folder_.trial(other.id));
    StopForNumber(trial, *missing, any && spec_.engine.kind == EngineKind::kCommand);
  }
  std::optional<imaging::GrayImage> profile;
  if (ReferenceOf(trial).has_image()) profile = std::move(output.profile);
  Keep(trial, std::move(profile));
}

// Once: it is of the deck, and other trials have the same in other digits.
void Campaign::SayDoubt(const journal::TrialRecord& trial, const std::string& doubt) {
  if (doubt.empty() || std::exchange(has_doubted_, true)) return;
  console_.Line("warning: trial " + std::to_string(trial.id) + ": " + doubt);
}

void Campaign::FailOrRetry(journal::TrialRecord& trial, const std::string& reason) {
  // Neither a full disk nor a lost folder is the parameters' fault; nothing is recorded, and the
  // trial is run again.
  RequireWritable(folder_.root);
  if (const auto folder = folder_.trial(trial.id); !std::filesystem::exists(folder)) {
    throw base::Error(folder.string() +
                      ": has vanished while its trial ran; `talus resume` runs the trial again");
  }
  if (trials::LogSaysUnwritten(folder_.trial(trial.id))) StopForDisk(trial, reason);
  if (spec_.retry_failed && trial.attempts == 1) {
    parts_.runner->Forget(JobOf(trial));
    ++trial.attempts;
    trial.seed = planner_.SeedOf(trial);
    journal_.Restart({&trial, 1});
    journal_.AddEvent("retry", trial.id, reason);
    console_.Line("trial " + std::to_string(trial.id) + " failed (" + reason +
                  "); it is tried again with another seed");
    waiting_.push_back(trial);
    return;
  }
  trial.status = journal::TrialStatus::kFailed;
  trial.reason = reason;
  Keep(trial, {});
}

void Campaign::Keep(journal::TrialRecord& trial, std::optional<imaging::GrayImage> profile) {
  trial.finished_utc = journal::UtcNow();
  if (AreToldInTurn(spec_) && NextInTurn(planner_.trials()) != trial.id) {
    journal_.NoteEnd(trial);  // who resumes finds the result, and not how long it took
  }
  ended_.push_back({.trial = std::move(trial), .profile = std::move(profile)});
}

// The trial whose turn it is; all that have ended where there are no turns.
bool Campaign::TellEnded() {
  if (!AreToldInTurn(spec_)) {
    for (EndedTrial& ended : ended_) Tell(ended);
    return !std::exchange(ended_, {}).empty();
  }
  const auto next = NextInTurn(planner_.trials());
  const auto found =
      std::ranges::find_if(ended_, [&](const EndedTrial& ended) { return ended.trial.id == next; });
  if (found == ended_.end()) return false;
  Tell(*found);
  ended_.erase(found);
  return true;
}

void Campaign::Tell(EndedTrial& ended) {
  auto& [trial, profile] = ended;
  KeepTrial(folder_, trial);  // a journal that is made anew measures it again, but cannot time it
  journal_.Finish(trial, profile ? imaging::EncodePng(*profile) : std::string());
  NoteElapsed();
  planner_.Finished(trial, profile ? ReferenceOf(trial).Field(*profile) : std::vector<float>());
  NoteBest(trial);
  Report(trial);
}

void Campaign::NoteElapsed(std::chrono::seconds period) {
  if (Clock::now() - noted_ < period) return;
  noted_ = Clock::now();
  NoteProgress();
}

void Campaign::NoteBest(const journal::TrialRecord& trial) {
  const auto value = ReferenceOf(trial).Value(trial);
  if (trial.status != journal::TrialStatus::kOk || !trial.IsOfSearch() || !value) return;
  // Objectives of different experiments or grain sizes do not compare.
  if (trial.experiment != 0 || trial.scale_factor != spec_.coarse_graining.scale_factor) return;
  if (!best_ || *value < best_->first) best_ = {*value, trial.id};
}

void Campaign::Report(const journal::TrialRecord& trial) {
  TrialProgress progress = ProgressOf(trial, record_, ReferenceOf(trial), spec_.objective);
  progress.best = best_ && best_->second == trial.id;
  console_.Trial(progress);
}

void Campaign::ShowTrouble() {
  const std::string trouble = parts_.runner->Trouble();
  if (!trouble.empty() && trouble != trouble_) console_.Line("warning: " + trouble);
  trouble_ = trouble;
}

void Campaign::ShowStatus() {
  const BudgetUse use = UseOf(spec_, planner_.trials(), Elapsed(),
                              std::max(1, parts_.runner->Capacity()), planner_.CoreTimeOfGoal());
  const int num_waiting = parts_.runner->NumWaiting();
  CampaignProgress progress{.num_search = use.num_search,
                            .num_confirm = use.num_confirm,
                            .budget = spec_.budget.simulations,
                            .used = UseText(spec_.budget, use, Elapsed()),
                            .core_seconds_budget = spec_.budget.core_time,
                            .num_running = static_cast<int>(running_.size()) - num_waiting,
                            .num_waiting = num_waiting,
                            .unit = std::string(journal::InfoOf(spec_.objective).unit),
                            .seconds_left = use.seconds_left};
  if (spec_.budget.core_time) progress.core_seconds = use.core_seconds;
  if (best_) std::tie(progress.best, progress.best_trial) = *best_;
  console_.Status(progress);
  ShowTrouble();
}

}  // namespace talus::campaign
