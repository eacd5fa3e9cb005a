// Simulations beside a campaign's own trials: what is made again by a second call, and what is not.
#include "experiments/campaign/run_cases.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "experiments/campaign/answer/joint_view.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/drawn_runner.h"

namespace talus::campaign {
namespace run_cases_test {

namespace fs = std::filesystem;

// Ends every job with this exit status after 3 s of processor time, and leaves nothing.
class EndsBy : public runners::Runner {
 public:
  explicit EndsBy(int status, runners::JobEnd end = runners::JobEnd::kExit)
      : status_(status), end_(end) {}
  int Capacity() const override { return 1; }
  bool JobsOutliveUs() const override { return false; }
  std::vector<std::string> Submit(std::span<const runners::Job> jobs) override {
    for (const runners::Job& job : jobs) ids_.push_back(job.id);
    return std::vector<std::string>(jobs.size());
  }
  bool Adopt(const runners::Job&, const std::string&) override { return false; }
  std::vector<runners::FinishedJob> Wait(double) override {
    std::vector<runners::FinishedJob> finished;
    for (const std::int64_t id : std::exchange(ids_, {})) {
      finished.push_back(
          {.id = id, .end = end_, .exit_status = status_, .reason = {}, .cpu_time = 3, .host = {}});
    }
    return finished;
  }
  void Cancel(std::int64_t) override {}

 private:
  int status_;
  runners::JobEnd end_;
  std::vector<std::int64_t> ids_;
};

class FailedCasesTest : public CampaignFixture {
 protected:
  // A case for each of these frictions; below 0.3 there is no heap.
  bool Run(const std::vector<double>& frictions, bool has_program = true) {
    const JointView view = ReadJointView(folder_);
    const CampaignParts parts{.runner = MakeDrawnRunner(view.spec, folder_),
                              .engine = std::make_unique<FakeEngine>(FakeEngineOptions{
                                  .fail_at_low = true, .no_command = !has_program})};
    return RunCases({.spec = view.spec,
                     .count = frictions.size(),
                     .at =
                         [&](std::size_t i) {
                           rigs::Case rig_case = TypicalCase(view.spec, 0, 1);
                           rig_case.powder.material.sliding_friction = frictions[i];
                           return FolderCase{.folder = Place(i), .rig_case = rig_case};
                         }},
                    parts);
  }
  fs::path Place(std::size_t i) const { return folder_ / "beside" / std::to_string(i + 1); }
  bool HasFailed(std::size_t i) const {
    FakeEngine engine{{}};
    const rigs::Case rig_case = TypicalCase(ReadJointView(folder_).spec, 0, 1);
    const CaseOutcome outcome = OutcomeOf({.folder = Place(i), .rig_case = rig_case}, engine);
    return outcome.has_ended && !outcome.output;
  }

  fs::path folder_ = Begin(R"(, "budget": {"simulations": 4}, "workers": 1)");
};

// `talus next` simulated its failures anew at every call, and counted nothing of their time.
TEST_F(FailedCasesTest, WhatFailedBesideOthersIsNotMadeAgain) {
  ASSERT_TRUE(Run({0.2, 0.5}));
  EXPECT_TRUE(HasFailed(0));
  EXPECT_FALSE(HasFailed(1));
  EXPECT_TRUE(Run({0.2, 0.5}, false));  // without a program: whatever it had to run would stop it
  EXPECT_TRUE(Run({0.6, 0.5}));         // another case in the same place is none that failed
  EXPECT_FALSE(HasFailed(0));
}

// One that somebody ended has saved a checkpoint, and exits by 130: it was never run again.
TEST_F(FailedCasesTest, WhatWasInterruptedHasNotFailed) {
  ASSERT_TRUE(Run({0.5}));  // where nothing has succeeded no marks are kept
  const JointView view = ReadJointView(folder_);
  for (const int status : {base::kExitInterrupted, 1}) {
    const CampaignParts parts{.runner = std::make_unique<EndsBy>(status),
                              .engine = std::make_unique<FakeEngine>(FakeEngineOptions{})};
    const auto at = [&](std::size_t i) {
      rigs::Case rig_case = TypicalCase(view.spec, 0, 1);
      rig_case.powder.material.sliding_friction = 0.5 + 0.1 * static_cast<double>(i);
      return FolderCase{.folder = Place(i), .rig_case = rig_case};
    };
    RunCases({.spec = view.spec, .count = 2, .at = at}, parts);
    EXPECT_EQ(HasFailed(1), status == 1);
  }
}

// Marks that an earlier call left where nothing had succeeded: a mended set-up was never asked
// again.
TEST_F(FailedCasesTest, MarksAloneAreNoReasonToLeaveOut) {
  ASSERT_TRUE(Run({0.2, 0.5}));
  fs::remove_all(Place(1));
  EXPECT_ANY_THROW(Run({0.2, 0.5}, false));
  EXPECT_FALSE(HasFailed(0));
}

// Capped runs of a goal took 24 core seconds of which nothing was counted, at each look again.
TEST_F(FailedCasesTest, TheTimeOfEveryAttemptIsCounted) {
  const JointView view = ReadJointView(folder_);
  FakeEngine engine{{}};
  const FolderCase run{.folder = Place(0), .rig_case = TypicalCase(view.spec, 0, 1)};
  for (const runners::JobEnd end : {runners::JobEnd::kTimeCap, runners::JobEnd::kOutOfMemory,
                                    runners::JobEnd::kPreempted, runners::JobEnd::kExit}) {
    const CampaignParts parts{.runner = std::make_unique<EndsBy>(1, end),
                              .engine = std::make_unique<FakeEngine>(FakeEngineOptions{})};
    RunCases({.spec = view.spec, .count = 1, .at = [&](std::size_t) { return run; }}, parts);
  }
  EXPECT_FALSE(OutcomeOf(run, engine).has_ended);  // where all fail no marks are kept
  EXPECT_DOUBLE_EQ(OutcomeOf(run, engine).core_time, 4 * 3);
  ASSERT_TRUE(Run({0.5}));  // another case in the same place
  EXPECT_LT(OutcomeOf(run, engine).core_time, 3);
}

TEST_F(FailedCasesTest, WhereAllFailTheSetUpIsWrongAndTheyAreMadeAgain) {
  ASSERT_TRUE(Run({0.2, 0.25}));
  EXPECT_FALSE(HasFailed(0));
  EXPECT_ANY_THROW(Run({0.2, 0.25}, false));
}

// Its commands end well whatever they leave; below 0.3 that is no heap.
class RefusingEngine : public FakeEngine {
 public:
  using FakeEngine::FakeEngine;
  void Forget(const fs::path& folder) override { fs::remove(folder / "profile.png"); }
  trials::TrialOutput Collect(const rigs::Case& rig_case, const fs::path& folder) override {
    if (rig_case.powder.material.sliding_friction >= 0.3) {
      return FakeEngine::Collect(rig_case, folder);
    }
    Forget(folder);
    throw base::Error("left no heap");
  }
};

class RefusedCasesTest : public CampaignFixture {
 protected:
  FolderCase At(std::size_t i) const {
    FolderCase run{.folder = folder_ / "beside" / std::to_string(i + 1),
                   .rig_case = TypicalCase(ReadJointView(folder_).spec, 0, 1)};
    run.rig_case.powder.material.sliding_friction = frictions_[i];
    return run;
  }
  // With or without somebody who looks at each case as soon as it has ended.
  void Run(bool has_program, bool looks) {
    const JointView view = ReadJointView(folder_);
    const CampaignParts parts{
        .runner = MakeDrawnRunner(view.spec, folder_),
        .engine = std::make_unique<RefusingEngine>(FakeEngineOptions{.no_command = !has_program})};
    CaseRuns runs{
        .spec = view.spec, .count = frictions_.size(), .at = [&](std::size_t i) { return At(i); }};
    if (looks) {
      runs.has_ended = [&](std::size_t i) {
        try {
          if (parts.engine->IsComplete(At(i).folder)) {
            parts.engine->Collect(At(i).rig_case, At(i).folder);
          }
        } catch (const base::Error&) {
        }
      };
    }
    RunCases(runs, parts);
  }
  CaseOutcome Outcome(std::size_t i) const {
    RefusingEngine engine{{}};
    return OutcomeOf(At(i), engine);
  }

  std::vector<double> frictions_;
  fs::path folder_ = Begin(R"(, "budget": {"simulations": 4}, "workers": 1)");
};

// Beside others it has failed as one that left nothing: neither call makes it again.
TEST_F(RefusedCasesTest, ARefusedResultIsAFailure) {
  for (const bool looks : {false, true}) {
    fs::remove_all(folder_ / "beside");
    frictions_ = {0.5, 0.2};
    Run(true, looks);
    EXPECT_TRUE(Outcome(0).output);
    for (int look = 0; look < 2; ++look) {
      EXPECT_TRUE(Outcome(1).has_ended);
      EXPECT_FALSE(Outcome(1).output);
    }
    EXPECT_NO_THROW(Run(false, looks));  // whatever it had to run would stop it
  }
}

// A mended program was never asked again, as its former ends counted as success.
TEST_F(RefusedCasesTest, WhereAllAreRefusedTheyAreMadeAgain) {
  for (const bool looks : {false, true}) {
    fs::remove_all(folder_ / "beside");
    frictions_ = {0.2, 0.25};
    Run(true, looks);
    EXPECT_FALSE(Outcome(0).has_ended);
    EXPECT_ANY_THROW(Run(false, looks));
  }
}

}  // namespace run_cases_test
}  // namespace talus::campaign
