// What becomes of a campaign that is gone on with after it has ended or was ended.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/campaign/run_cases.h"
#include "experiments/journal/record_json.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/slurm_fixture.h"

namespace talus::campaign {
namespace going_on_test {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kSmall = R"(, "budget": {"simulations": 10}, "workers": 1,
    "strategy": {"kind": "sobol"}, "confirm": {"candidates": 1, "replicates": 2})";

class GoingOnTest : public CampaignFixture {
 protected:
  static journal::ProgressRecord Progress(const fs::path& folder) {
    return journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Progress();
  }
  static CampaignSpec SpecOf(const fs::path& folder) {
    return ParseSpecText(
        journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_json);
  }
  static int NumSearch(const fs::path& folder) {
    return static_cast<int>(
        std::ranges::count_if(Trials(folder), &journal::TrialRecord::IsOfSearch));
  }
};

// A queue that has each job already, or has none and takes it; all end at once, in the same way.
class StubQueue : public runners::Runner {
 public:
  StubQueue(bool has_it, runners::JobEnd end) : has_it_(has_it), end_(end) {}
  int Capacity() const override { return 1; }
  bool JobsOutliveUs() const override { return true; }
  std::vector<std::string> Submit(std::span<const runners::Job> jobs) override {
    log_ += "submit ";
    ids_.push_back(jobs[0].id);
    return {"7_0"};
  }
  bool Adopt(const runners::Job& job, const std::string&) override {
    log_ += "adopt ";
    if (has_it_) ids_.push_back(job.id);
    return has_it_;
  }
  void Forget(const runners::Job&) override { log_ += "forget "; }
  std::vector<runners::FinishedJob> Wait(double) override {
    std::vector<runners::FinishedJob> finished;
    for (const std::int64_t id : std::exchange(ids_, {})) {
      finished.push_back(
          {.id = id, .end = end_, .reason = "sbatch: no such partition", .host = {}});
    }
    return finished;
  }
  void Cancel(std::int64_t) override {}
  const std::string& log() const { return log_; }

 private:
  bool has_it_;
  runners::JobEnd end_;
  std::vector<std::int64_t> ids_;
  std::string log_;
};

class RunCasesTest : public GoingOnTest {
 protected:
  // What the queue was asked for one run, whose folder an earlier process may have made ready.
  std::string LogOf(bool has_it, runners::JobEnd end = runners::JobEnd::kExit) {
    const FolderCase run{.folder = scratch_.path() / "0001", .rig_case = {}};
    auto queue = std::make_unique<StubQueue>(has_it, end);
    const StubQueue& asked = *queue;
    const CampaignParts parts{.runner = std::move(queue),
                              .engine = std::make_unique<FakeEngine>(FakeEngineOptions{})};
    const CampaignSpec spec;
    RunCases({.spec = spec, .count = 1, .at = [&](std::size_t) { return run; }}, parts);
    return asked.log();
  }
};

// Killed before it had noted the job's name, it submitted the job once more. One that has ended
// without a result is simulated again.
TEST_F(RunCasesTest, WhatAQueueHasAlreadyIsNotSubmittedTwice) {
  EXPECT_EQ(LogOf(false), "submit forget ");  // nobody has made the folder ready
  EXPECT_EQ(LogOf(true), "adopt forget ");
  EXPECT_EQ(LogOf(false), "adopt submit forget ");
}

// `talus predict` said that it had left no result.
TEST_F(RunCasesTest, WhatAQueueRefusesIsSaid) {
  const auto refused = [&] { LogOf(false, runners::JobEnd::kNotStarted); };
  EXPECT_THAT(ErrorIn<base::Error>(refused), HasSubstr("sbatch: no such partition"));
}

// Killed after the images and before campaign.json: there was nothing to resume, and `calibrate`
// refused the folder.
TEST_F(GoingOnTest, ABeginningThatWasKilledIsBegunAgain) {
  const fs::path folder = scratch_.path() / "run";
  fs::create_directories(folder / "experiment_2");
  for (const char* name : {"aehp.png", "run_01.png", "campaign.json.tmp7"}) {
    std::ofstream(folder / name) << "x";
  }
  EXPECT_THAT(ErrorIn([&] { Begin(kSmall); }), HasSubstr("holds other files"));  // anybody's
  std::ofstream(folder / "campaign.lock") << "";
  Begin(kSmall);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
}

// Ctrl-C comes before anything else.
CampaignEnd ResumeInterrupted(const fs::path& folder, const ResumeOptions& options) {
  const base::InterruptGuard interrupt;
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  OpenedCampaign opened = OpenCampaign(folder, options, console);
  CampaignParts parts{.runner = MakeDrawnRunner(opened.spec, opened.folder.root),
                      .engine = std::make_unique<FakeEngine>(FakeEngineOptions{})};
  Campaign campaign(opened.folder, std::move(opened.lock), std::move(opened.journal), opened.spec,
                    std::move(parts), console);
  std::raise(SIGINT);
  return campaign.Run(interrupt);
}

TEST_F(GoingOnTest, CtrlCLeavesACampaignThatHasEndedAsItWas) {
  const fs::path folder = Finished(kSmall);
  const journal::ProgressRecord before = Progress(folder);
  EXPECT_EQ(ResumeInterrupted(folder, {}), CampaignEnd::kInterrupted);
  EXPECT_EQ(Progress(folder).state, journal::CampaignState::kFinished);
  EXPECT_EQ(Progress(folder).stop_reason, before.stop_reason);
  EXPECT_EQ(Progress(folder).result_json, before.result_json);
}

// The former answer stood beside a report that had none.
TEST_F(GoingOnTest, AResultIsGoneWhileTheSearchGoesOn) {
  const fs::path folder = Finished(kSmall);
  const auto has = [&](const char* name) { return fs::exists(folder / name); };
  EXPECT_TRUE(has("result.json") && has("posterior.csv"));
  EXPECT_EQ(ResumeInterrupted(folder, {.add_simulations = 3}), CampaignEnd::kInterrupted);
  EXPECT_EQ(Progress(folder).result_json, "");
  EXPECT_FALSE(has("result.json") || has("posterior.csv"));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_TRUE(has("result.json") && has("posterior.csv"));
}

// The next resume read the first one again, and undid what the other had changed.
TEST_F(GoingOnTest, AnotherSpecThatIsNamedOnceIsReadFromThenOn) {
  const fs::path folder = Begin(kSmall);
  const fs::path former = scratch_.path() / "run_in" / "spec.json";
  std::string text = base::ReadFile(former);
  text.replace(text.find("\"simulations\": 10"), 17, "\"simulations\": 11");
  const fs::path other = scratch_.path() / "run_in" / "other.json";
  std::ofstream(other) << text;
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  EXPECT_EQ(OpenCampaign(folder, {.spec = other}, console).spec.budget.simulations, 11);
  EXPECT_EQ(OpenCampaign(folder, {}, console).spec.budget.simulations, 11);
  const auto record = journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign();
  EXPECT_EQ(record.spec_path, other);
}

// Nothing of it could be changed any more: its map lay elsewhere.
TEST_F(GoingOnTest, AProjectThatWasMovedTakesAChangedSpec) {
  const fs::path former = scratch_.path() / "former", now = scratch_.path() / "now";
  BeginCampaign(WriteFakeSpec(former, kSmall), former / "run");
  fs::rename(former, now);
  std::string text = base::ReadFile(now / "spec.json");
  text.replace(text.find("\"simulations\": 10"), 17, "\"simulations\": 11");
  std::ofstream(now / "spec.json") << text;
  Console console(now / "campaign.log", Console::Output::kQuiet);
  const ResumeOptions options{.spec = now / "spec.json"};
  EXPECT_EQ(OpenCampaign(now / "run", options, console).spec.budget.simulations, 11);
  fs::rename(now / "map.png", now / "other.png");
  text.replace(text.find("map.png"), 7, "other.png");
  std::ofstream(now / "spec.json") << text;
  EXPECT_THAT(ErrorIn([&] { OpenCampaign(now / "run", options, console); }),
              HasSubstr("experiment.map: "));
}

// A folder that cannot be looked into, as somebody's private one, ended each of them.
TEST_F(GoingOnTest, WhatCannotBeLookedAtIsNotThere) {
  const fs::path folder = Begin(kSmall);
  const fs::path input = scratch_.path() / "run_in";
  fs::remove_all(input);
  fs::create_symlink(input, input);  // leads nowhere, also where tests are run by root
  fs::create_directories(folder / "mine");
  fs::create_symlink(folder / "mine/slurm", folder / "mine/slurm");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_THAT(base::ReadFile(folder / "campaign.log"),
              HasSubstr("spec.json: is not there or cannot be read; it goes on by the spec in "));
}

// A comment in the spec's file took the answer away and searched on.
TEST_F(GoingOnTest, OnlyWhatTheSearchDependsOnOpensOneThatHasEnded) {
  const fs::path folder = Begin(kSmall);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const fs::path spec = scratch_.path() / "run_in" / "spec.json";
  const std::string text = base::ReadFile(spec);
  const auto resumed_with = [&](const std::string& changed) {
    std::ofstream(spec) << changed;
    Console console(folder / "campaign.log", Console::Output::kQuiet);
    OpenCampaign(folder, {}, console);
    return Progress(folder).state;
  };
  std::string renamed = text;
  renamed.replace(renamed.find("fake"), 4, "again");
  std::string larger = text;
  larger.replace(larger.find("\"simulations\": 10"), 17, "\"simulations\": 11");
  EXPECT_EQ(resumed_with("// noted later\n" + text), journal::CampaignState::kFinished);
  EXPECT_EQ(resumed_with(renamed), journal::CampaignState::kFinished);
  EXPECT_NE(Progress(folder).result_json, "");
  EXPECT_EQ(resumed_with(larger), journal::CampaignState::kInterrupted);
}

TEST_F(GoingOnTest, AnExtensionIsStillThereInAJournalThatIsMadeAnew) {
  const fs::path folder = Begin(kSmall);
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  EXPECT_EQ(OpenCampaign(folder, {.add_simulations = 5}, console).spec.budget.simulations, 15);
  fs::remove(journal::JournalPath(folder));
  EXPECT_EQ(OpenCampaign(folder, {}, console).spec.budget.simulations, 15);
}

// Its last trials counted by an estimate; where they took less, the budget had room again, and what
// had been confirmed was confirmed anew after them.
TEST_F(GoingOnTest, ASearchThatIsBeingConfirmedDoesNotGoOnByItself) {
  const fs::path folder = Begin(R"(, "budget": {"core_time": "1 ms"}, "workers": 1,
    "strategy": {"kind": "sobol"}, "confirm": {"candidates": 1, "replicates": 2})");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const std::size_t num_trials = Trials(folder).size();
  const Stop stop = journal::ParseRecord<Stop>(Progress(folder).stop_json, "stop");
  EXPECT_EQ(stop.kind, StopKind::kCoreTime);
  {  // as if it had been killed before its end, and its trials had taken less
    auto journal = journal::Journal::Open(journal::JournalPath(folder));
    journal::CampaignRecord record = journal.Campaign();
    CampaignSpec spec = SpecOf(folder);
    spec.budget.core_time = 3600;
    record.spec_json = SpecText(spec);
    journal.SetSpec(record);
    journal.SetProgress(
        {.state = journal::CampaignState::kRunning, .stop_json = Progress(folder).stop_json});
  }
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(Trials(folder).size(), num_trials);
}

// A full disk, say: the search was open again by then, under the budget that it had not used.
TEST_F(GoingOnTest, AnExtensionThatCannotBeWrittenLeavesTheSearchEnded) {
  const fs::path folder = Finished(kSmall);
  const journal::ProgressRecord before = Progress(folder);
  const std::size_t num_trials = Trials(folder).size();
  const std::string image = base::ReadFile(folder / "aehp.png");
  fs::remove(folder / "aehp.png");
  fs::create_directories(folder / "aehp.png/in_the_way");
  EXPECT_THROW(RunFake(folder, {}, {.add_simulations = 2}), base::Error);
  EXPECT_EQ(Progress(folder).state, journal::CampaignState::kFinished);
  EXPECT_EQ(Progress(folder).stop_json, before.stop_json);
  fs::remove_all(folder / "aehp.png");
  base::WriteFileAtomically(folder / "aehp.png", image);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(Trials(folder).size(), num_trials);
}

// Its trials do not tell how long they were worked on.
TEST_F(GoingOnTest, AJournalThatIsMadeAnewKnowsThatTheSearchHasEndedAndWhy) {
  const fs::path folder = Begin(R"(, "budget": {"wall_clock": "1 s"}, "workers": 1,
    "strategy": {"kind": "sobol"}, "confirm": {"candidates": 1, "replicates": 2})");
  EXPECT_EQ(RunFake(folder, {.sleep = 0.1}), CampaignEnd::kFinished);
  const std::string table = TrialTable(folder);
  fs::remove(journal::JournalPath(folder));
  EXPECT_THAT(ErrorIn<base::Error>([&] { Trials(folder); }),
              HasSubstr("`talus resume` makes it anew"));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(folder), table);
  EXPECT_EQ(Result(folder).stop.kind, StopKind::kWallClock);
  // What it was extended by since holds, and it goes on.
  EXPECT_EQ(RunFake(folder, {}, {.add_simulations = 2}), CampaignEnd::kFinished);
  const std::string longer = TrialTable(folder);
  EXPECT_GT(longer.size(), table.size());
  fs::remove(journal::JournalPath(folder));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(folder), longer);
}

TEST_F(GoingOnTest, ADamagedTrialIsRunAgainByAJournalThatIsMadeAnew) {
  const fs::path folder = Finished(kSmall);
  const std::string table = TrialTable(folder);
  std::ofstream(folder / "trials/0002/trial.json", std::ios::app) << "x";
  fs::remove(journal::JournalPath(folder));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(folder), table);
}

// A coordinate too many ended it with "FOREIGN KEY constraint failed", beside an empty journal.
TEST_F(GoingOnTest, ATrialOfOtherParametersIsRunAgainByAJournalThatIsMadeAnew) {
  const fs::path folder = Finished(kSmall);
  const std::string table = TrialTable(folder);
  journal::TrialRecord other = Trials(folder).at(1);
  other.unit.push_back(0.5);
  other.native.push_back(0.5);
  KeepTrial(CampaignFolder{folder}, other);
  fs::remove(journal::JournalPath(folder));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(folder), table);
}

// One that ran when the eighth failed went well, and a session that was told of all of them at once
// found that some had succeeded.
TEST_F(GoingOnTest, ASearchWhoseFirstTrialsAllFailedStaysEnded) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 20}, "workers": 2,
    "strategy": {"kind": "sobol"}, "confirm": {"candidates": 0})");
  const FakeEngineOptions engine{.fail_first = 8};
  RunFake(folder, engine);
  const std::string table = TrialTable(folder);
  const std::vector<journal::TrialRecord> trials = Trials(folder);
  ASSERT_LT(trials.size(), 20u);
  ASSERT_EQ(trials.back().status, journal::TrialStatus::kOk);
  journal::Journal::Open(journal::JournalPath(folder))
      .SetProgress({});  // it was killed before its end
  RunFake(folder, engine);
  EXPECT_EQ(TrialTable(folder), table);
}

// A budget of core time counted the last attempt only.
TEST_F(GoingOnTest, ATrialHasTakenWhatAllItsAttemptsTook) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 1}, "workers": 1,
    "retry_failed": true, "strategy": {"kind": "sobol"}, "confirm": {"candidates": 0})");
  RunFake(folder, {.fail_once = true, .sleep = 0.2});
  EXPECT_EQ(Trials(folder).at(0).attempts, 2);
  EXPECT_GE(Trials(folder).at(0).duration_s, 0.4);
}

// Its confirmations were taken for those at the new scale factor, and simulated no more.
TEST_F(GoingOnTest, GrainsOfAnotherSizeConfirmAnew) {
  const auto keys = [](const std::string& confirm) {
    return R"(, "budget": {"simulations": 10}, "workers": 1, "strategy": {"kind": "sobol"},
      "coarse_graining": {"scale_factor": 2}, "confirm": {"candidates": 1, "ends": false, )" +
           confirm + "}";
  };
  const fs::path folder = Begin(keys(R"("replicates": 2)"));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  WriteFakeSpec(scratch_.path() / "run_in", keys(R"("replicates": 3, "scale_factor": 1.5)"));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  int num_finer = 0;
  for (const journal::TrialRecord& trial : Trials(folder)) num_finer += trial.scale_factor == 1.5;
  EXPECT_EQ(num_finer, 3);
  const Answer answer = ParseAnswer(base::ReadFile(folder / "result.json"));
  EXPECT_EQ(answer.confirmed.at(0).scale_factor, 1.5);
  EXPECT_EQ(answer.confirmed.at(0).experiments.at(0).num_trials, 3);
}

// Two processes would have written into one folder.
class ToLocalTest : public runners::SlurmRunnerTest {};

TEST_F(ToLocalTest, JobsThatAreStillInTheQueueAreNotRunHereAsWell) {
  const fs::path folder = root_ / "run";
  BeginCampaign(WriteFakeSpec(root_ / "run_in", kSmall), folder);
  EXPECT_THROW(RunFake(folder, {.no_command = true}), base::Error);  // leaves the first one running
  Put("hold", "");
  const runners::Job job{.id = 1, .folder = folder / "trials/0001", .command = {"true"}};
  runners::SlurmRunner(options_, folder).Submit({&job, 1});
  Put("queue", "101_0|RUNNING|None\n");
  EXPECT_THAT(ErrorIn([&] { RunFake(folder, {}); }), HasSubstr("1 job of this campaign may still"));
  Put("queue_is_down", "");
  EXPECT_THAT(ErrorIn<base::Error>([&] { RunFake(folder, {}); }), HasSubstr("squeue does not say"));
  fs::remove(root_ / "queue_is_down");
  Put("queue", "101_0|CANCELLED|None\n");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
}

// As many were added to a budget that had run out, and none was simulated.
TEST_F(GoingOnTest, WhatAWallClockHasEndedGoesOnWithSoManyMore) {
  const fs::path folder =
      Begin(R"(, "budget": {"simulations": 10, "wall_clock": "1 h"}, "workers": 1,
    "strategy": {"kind": "sobol"}, "confirm": {"candidates": 0})");
  journal::Journal::Open(journal::JournalPath(folder))
      .SetProgress({.state = journal::CampaignState::kInterrupted, .elapsed_s = 7200});
  RunFake(folder, {});
  EXPECT_THAT(Progress(folder).stop_reason, HasSubstr("the time budget of"));
  EXPECT_EQ(NumSearch(folder), 0);
  RunFake(folder, {}, {.add_simulations = 3});
  EXPECT_EQ(NumSearch(folder), 3);
}

TEST_F(GoingOnTest, ABudgetOfCoreTimeThatIsNotUsedGrowsByWhatSoManyTake) {
  const fs::path folder = Begin(R"(, "budget": {"core_time": "1 h"}, "workers": 1)");
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  const CampaignSpec more = OpenCampaign(folder, {.add_simulations = 5}, console).spec;
  EXPECT_GT(more.budget.core_time.value(), 3600);
  EXPECT_EQ(more.budget.simulations, 0);
  const CampaignSpec again = OpenCampaign(folder, {.add_simulations = 5}, console).spec;
  EXPECT_NEAR(*again.budget.core_time - 3600, 2 * (*more.budget.core_time - 3600), 1e-6);
}

}  // namespace going_on_test
}  // namespace talus::campaign
