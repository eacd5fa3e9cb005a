// When a session begins: what earlier ones and former campaigns have left is taken up.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/text/counted.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/campaign.h"
#include "experiments/campaign/mended_engine.h"
#include "experiments/campaign/plan/turns.h"
#include "experiments/runners/slurm_runner.h"

namespace talus::campaign {
namespace {

// Jobs that a queue was given for this folder: `jobs` where they are given, else all.
void RequireNoneQueued(const runners::SlurmOptions& options, const std::filesystem::path& folder,
                       const std::vector<runners::Job>* jobs) {
  const std::filesystem::path records = folder / "slurm";
  std::error_code unknown;  // in a folder that is somebody's private one, and so none of ours
  if (!std::filesystem::exists(records, unknown)) return;
  runners::SlurmRunner former(options, folder);
  int num_queued = 0;
  try {
    for (const runners::Job& job : jobs != nullptr ? *jobs : former.Known()) former.Adopt(job, "");
    num_queued = former.NumInQueue();
  } catch (const base::Error& error) {
    throw base::Error(std::string(error.what()) +
                      "; its jobs must have ended before trials run on this machine: resume "
                      "where Slurm answers, or remove " +
                      records.string() + " if you know that they have");
  }
  if (num_queued == 0) return;
  throw base::ConfigError("runner: " + base::Counted(num_queued, "job") +
                          " of this campaign may still run in Slurm's queue, and would run here a "
                          "second time; end them with scancel, or resume with the former runner");
}

// Trials that a cluster's queue has would run a second time on this machine, in the same folders;
// so would the runs beside them, of a goal, a prediction or a further test.
void RequireNoneQueued(const CampaignSpec& spec, const std::filesystem::path& root,
                       const std::vector<runners::Job>& jobs) {
  if (spec.runner.kind != RunnerKind::kLocal) return;
  RequireNoneQueued(spec.runner.slurm, root, &jobs);
  constexpr int kDeepest = 1;  // DIR/predict/NAME
  std::error_code unreadable;
  std::filesystem::recursive_directory_iterator entry(
      root, std::filesystem::directory_options::skip_permission_denied, unreadable);
  for (; entry != std::filesystem::recursive_directory_iterator(); entry.increment(unreadable)) {
    std::error_code gone;
    if (!entry->is_directory(gone)) continue;
    RequireNoneQueued(spec.runner.slurm, entry->path(), nullptr);
    if (entry.depth() == kDeepest || entry->path().filename() == "trials") {
      entry.disable_recursion_pending();
    }
  }
}

}  // namespace

// The set-up was wrong, and whoever resumes has mended it: none of these trials tells of its set.
// While a search goes on a few that have failed are enough where no trial at all has succeeded.
// Folders first: a session that ends in between does all of it again.
void Campaign::RunFailedAgain() {
  const std::vector<journal::TrialRecord> trials = journal_.Trials();
  const bool searches = stop_json_.empty();
  const bool none_has_succeeded =
      searches && std::ranges::none_of(trials, [](const journal::TrialRecord& trial) {
        return trial.status == journal::TrialStatus::kOk &&
               trial.kind != journal::TrialKind::kReused;
      });
  const std::set<int> failing = FailingExperiments(trials);
  std::vector<journal::TrialRecord> told_nothing, all_failed, tried_once;
  for (const journal::TrialRecord& trial : trials) {
    const bool has_failed =
        trial.status == journal::TrialStatus::kFailed && trial.kind != journal::TrialKind::kReused;
    if (parts_.engine_is_new) {
      if (trial.finish_order > 0 && !HasTold(trial)) told_nothing.push_back(trial);
    } else if (has_failed && (none_has_succeeded || failing.contains(trial.experiment))) {
      all_failed.push_back(trial);
    } else if (has_failed && searches && spec_.retry_failed && trial.attempts == 1) {
      tried_once.push_back(trial);
    }
  }
  const bool of_one = !none_has_succeeded && failing.size() == 1 && references_.size() > 1;
  RunFromTheBeginning(told_nothing, "with the former engine ");
  RunFromTheBeginning(
      all_failed, "all ",
      of_one ? " of \"" + record_.experiments.at(static_cast<std::size_t>(*failing.begin())).name +
                   "\""
             : "");
  RunFromTheBeginning(tried_once, "", " with one attempt");
  // They have failed with their own seed.
  for (journal::TrialRecord& trial : tried_once) {
    ++trial.attempts;
    trial.seed = planner_.SeedOf(trial);
  }
  if (!tried_once.empty()) journal_.Restart(tried_once);
}

// `which` and `of`: what stands before and after their number in the line that says so.
void Campaign::RunFromTheBeginning(const std::vector<journal::TrialRecord>& trials,
                                   const std::string& which, const std::string& of) {
  if (trials.empty()) return;
  const std::string& reason = trials.back().reason;
  console_.Line(which + base::Counted(std::ssize(trials), "trial") + of +
                (reason.empty() ? " told nothing" : " failed (the last: " + reason + ")") +
                ": run again");
  for (const journal::TrialRecord& trial : trials) {
    ForgetJob(trial);
    std::filesystem::remove_all(folder_.trial(trial.id));
    ++reruns_[trial.id];
  }
  journal_.Reopen(trials);
}

// By a queue that it was once given to as well: its records outlive the trial's folder, and would
// let it seem to wait there.
void Campaign::ForgetJob(const journal::TrialRecord& trial) {
  parts_.runner->Forget(JobOf(trial));
  if (spec_.runner.kind != RunnerKind::kLocal) return;
  if (!std::filesystem::exists(folder_.root / "slurm")) return;
  runners::SlurmRunner(spec_.runner.slurm, folder_.root).Forget(JobOf(trial));
}

bool Campaign::RunAgain(journal::TrialRecord& trial, const std::string& reason) {
  constexpr int kMostReruns = 3;        // where others keep ending it
  parts_.runner->Forget(JobOf(trial));  // whose time is counted
  if (++reruns_[trial.id] > kMostReruns) return false;
  journal_.AddEvent("rerun", trial.id, reason);
  journal_.Restart({&trial, 1});
  console_.Line("trial " + std::to_string(trial.id) + " " + reason + "; it is run again");
  waiting_.push_back(trial);
  return true;
}

// Trials become known by their ids, observations are told in the order in which they finished.
void Campaign::TellFinished() {
  const std::vector<journal::TrialRecord> trials = journal_.Trials();
  for (journal::TrialRecord trial : trials) {  // as they were known when they were started
    if (trial.finish_order > 0) {
      trial.status = journal::TrialStatus::kRunning;
      trial.metrics.clear();
    }
    planner_.Started(trial);
  }
  for (const journal::TrialRecord& trial : InOrderOfFinish(trials)) {
    planner_.Finished(trial, StoredField(journal_, folder_, references_, trial));
    NoteBest(trial);
  }
}

void Campaign::TakeUpRunning() {
  std::vector<runners::Job> jobs;
  for (const journal::TrialRecord& trial : journal_.Trials()) {
    if (trial.status == journal::TrialStatus::kRunning) jobs.push_back(JobOf(trial));
  }
  RequireNoneQueued(spec_, folder_.root, jobs);
  for (const journal::TrialRecord& trial : journal_.Trials()) {
    if (trial.status != journal::TrialStatus::kRunning) continue;
    if (parts_.runner->Adopt(JobOf(trial), trial.job)) {
      running_[trial.id] = trial;
      if (!parts_.engine_is_new) continue;
      stale_.insert(trial.id);
      parts_.runner->Cancel(trial.id);
    } else {
      waiting_.push_back(trial);
    }
  }
  NoteFormerEngineGone();
}

// Until then a session that ends leaves it to the next one to tell the former engine's trials.
void Campaign::NoteFormerEngineGone() {
  if (stale_.empty()) std::filesystem::remove(folder_.mended());
}

// They need no worker, and the first proposal waits for all of them.
void Campaign::CollectReused() {
  const auto is_there = [&](const journal::TrialRecord& trial) {
    return trial.kind == journal::TrialKind::kReused &&
           parts_.engine->IsComplete(folder_.trial(trial.id));
  };
  std::vector<journal::TrialRecord> reused;
  std::ranges::copy_if(waiting_, std::back_inserter(reused), is_there);
  if (reused.empty()) return;
  std::erase_if(waiting_, is_there);
  Submit(reused);
  while (TellEnded()) {
  }
  const auto answer = planner_.Recommend();
  if (answer && answer->posterior) {
    console_.Line(FirstAnswerText(*answer, planner_.space(), record_.parameters));
  }
}

}  // namespace talus::campaign
