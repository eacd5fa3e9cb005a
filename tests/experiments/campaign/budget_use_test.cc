// Budget used and time left: of trials that are as long as each other, closed forms.
#include "experiments/campaign/plan/budget_use.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "experiments/campaign/folder/console.h"
#include "experiments/campaign/folder/progress.h"

namespace talus::campaign {
namespace budget_use_test {

using testing::HasSubstr;

constexpr double kTrial = 10;  // [s] of each, wall clock and core time

CampaignSpec SpecOf(const BudgetOptions& budget) {
  CampaignSpec spec;
  spec.experiment.emplace();
  spec.budget = budget;
  spec.confirm = {.candidates = 1, .replicates = 3, .ends = false};
  spec.next.share = 0;
  return spec;
}

std::vector<journal::TrialRecord> Trials(int num_ended, int num_running,
                                         journal::TrialKind kind = journal::TrialKind::kSearch) {
  std::vector<journal::TrialRecord> trials(static_cast<std::size_t>(num_ended + num_running));
  for (std::size_t i = 0; i < trials.size(); ++i) {
    trials[i].id = static_cast<std::int64_t>(i) + 1;
    trials[i].kind = kind;
    trials[i].scale_factor = 1;
    if (static_cast<int>(i) >= num_ended) continue;
    trials[i].status = journal::TrialStatus::kOk;
    trials[i].duration_s = kTrial;
    trials[i].cpu_s = kTrial;
  }
  return trials;
}

// Two at a time: 20 trials took 100 s, so 40 more take 200 s, and 3 that confirm 20 s: the third
// has a worker to itself.
TEST(BudgetUse, SimulationsAreLeftAtThePaceSoFar) {
  const BudgetUse use = UseOf(SpecOf({.simulations = 60}), Trials(20, 2), 100, 2);
  EXPECT_EQ(use.num_search, 22);
  EXPECT_DOUBLE_EQ(use.seconds_left.value(), 200 + 20);
}

// 200 of 500 core seconds in 100 s: 150 s more.
TEST(BudgetUse, CoreTimeIsLeftAtThePaceSoFar) {
  const CampaignSpec spec = SpecOf({.simulations = 0, .core_time = 500});
  const BudgetUse use = UseOf(spec, Trials(20, 2), 100, 2);
  EXPECT_DOUBLE_EQ(use.core_seconds, 200);
  EXPECT_DOUBLE_EQ(use.seconds_left.value(), 150 + 20);
  EXPECT_EQ(UseText(spec.budget, use, 100), "22 simulations, 3 min of 8 min core time");
  EXPECT_EQ(UseText({.simulations = 1}, {.num_search = 1}, 100), "1 of 1 simulation");
  EXPECT_EQ(UseText({.simulations = 0}, {.num_search = 1}, 100), "1 simulation");
}

// Taken over from another campaign, on a faster machine it may be, or found after a kill, when
// nobody knows how long they took.
TEST(BudgetUse, TrialsOfOthersAndOfUnknownDurationAreNoPace) {
  const std::vector<journal::TrialRecord> own = Trials(20, 2);
  const auto alone = UseOf(SpecOf({.simulations = 60}), own, 100, 2);
  std::vector<journal::TrialRecord> trials = Trials(32, 0, journal::TrialKind::kReused);
  for (journal::TrialRecord& trial : trials) trial.duration_s = 0.01;
  trials.insert(trials.end(), own.begin(), own.end());
  EXPECT_EQ(UseOf(SpecOf({.simulations = 60}), trials, 100, 2).seconds_left, alone.seconds_left);
  std::vector<journal::TrialRecord> found = Trials(22, 2);
  found[0].duration_s = found[1].duration_s = 0;
  EXPECT_EQ(UseOf(SpecOf({.simulations = 62}), found, 100, 2).seconds_left, alone.seconds_left);
}

// "At most 6 s" was said at the start of twelve trials of 10 s with 20 workers.
TEST(BudgetUse, NothingTakesLessThanATrial) {
  const BudgetUse use = UseOf(SpecOf({.simulations = 30}), Trials(30, 0), 15, 20);
  EXPECT_DOUBLE_EQ(use.seconds_left.value(), kTrial);
  EXPECT_DOUBLE_EQ(UseOf(SpecOf({.simulations = 34}), Trials(30, 0), 15, 20).seconds_left.value(),
                   2 * kTrial);
}

// The trials under way at the budget's end go beyond it; what is said never does.
TEST(BudgetUse, NoMoreThanTheBudgetIsUsed) {
  const CampaignSpec spec = SpecOf({.simulations = 0, .core_time = 25});
  const BudgetUse use = UseOf(spec, Trials(3, 0), 15, 2);
  EXPECT_DOUBLE_EQ(use.core_seconds, 25);
  EXPECT_DOUBLE_EQ(use.seconds_left.value(), 20);  // the confirmation
  EXPECT_THAT(UseText(spec.budget, use, 15), HasSubstr("25 s of 25 s core time"));
}

TEST(BudgetUse, TheWallClockEndsASearchSooner) {
  const CampaignSpec spec = SpecOf({.simulations = 60, .wall_clock = 120});
  EXPECT_DOUBLE_EQ(UseOf(spec, Trials(20, 2), 100, 2).seconds_left.value(), 20 + 20);
}

TEST(BudgetUse, OnceItConfirmsOnlyThatIsLeft) {
  std::vector<journal::TrialRecord> trials = Trials(30, 0);
  for (const journal::TrialRecord& trial : Trials(1, 1, journal::TrialKind::kConfirm)) {
    trials.push_back(trial);
  }
  const BudgetUse use = UseOf(SpecOf({.simulations = 60}), trials, 160, 2);
  EXPECT_EQ(use.num_confirm, 2);
  EXPECT_DOUBLE_EQ(use.seconds_left.value(), 2 * kTrial / 2);
}

// A finished campaign whose budget is raised searches on, and confirms what it then finds.
TEST(BudgetUse, ASearchThatGoesOnAfterAConfirmationHasNotEnded) {
  std::vector<journal::TrialRecord> trials = Trials(8, 0);
  const auto add = [&](const std::vector<journal::TrialRecord>& more) {
    trials.insert(trials.end(), more.begin(), more.end());
  };
  add(Trials(3, 0, journal::TrialKind::kConfirm));
  add(Trials(12, 2));
  const BudgetUse use = UseOf(SpecOf({.simulations = 60}), trials, 100, 2);
  EXPECT_EQ(use.num_search, 22);
  EXPECT_EQ(use.num_confirm, 0);
  EXPECT_DOUBLE_EQ(use.seconds_left.value(), 200 + 20);
}

// The two ends are six trials more; further tests take a fifth of the core time of all, which is
// 200 s so far, 400 of the search and 100 of the confirmation, whose last trial runs alone.
TEST(BudgetUse, EndsAndFurtherTestsAreCounted) {
  CampaignSpec spec = SpecOf({.simulations = 60});
  spec.confirm.ends = true;
  EXPECT_DOUBLE_EQ(UseOf(spec, Trials(20, 2), 100, 2).seconds_left.value(), 200 + 10 * kTrial / 2);
  spec.next.share = 0.2;
  EXPECT_DOUBLE_EQ(UseOf(spec, Trials(20, 2), 100, 2).seconds_left.value(),
                   250 + 0.2 * (200 + 500) / 2);
}

// Coarse trials come first. Those at half the scale factor take 16 times as long: 40 of them, two
// at a time, and 3 to confirm.
TEST(BudgetUse, FinerTrialsToComeTakeLonger) {
  CampaignSpec spec = SpecOf({.simulations = 60});
  spec.coarse_graining.scale_factors = {2, 1};
  std::vector<journal::TrialRecord> trials = Trials(20, 2);
  for (journal::TrialRecord& trial : trials) trial.scale_factor = 2;
  EXPECT_DOUBLE_EQ(UseOf(spec, trials, 100, 2).seconds_left.value(), (40 + 4) * 16 * kTrial / 2);
}

TEST(BudgetUse, NothingIsSaidBeforeATrialHasEnded) {
  EXPECT_FALSE(UseOf(SpecOf({.simulations = 60}), Trials(0, 2), 5, 2).seconds_left.has_value());
}

TEST(Progress, TrialLinesNameTheirParameters) {
  const TrialProgress trial{.trial = 7,
                            .parameters = {"sliding_friction", "rolling_friction"},
                            .values = {0.3, 0.1},
                            .objective = 1.2,
                            .unit = "mm²",
                            .duration = 12};
  EXPECT_EQ(
      ProgressText(trial),
      "trial 7 (search) at sliding_friction 0.3, rolling_friction 0.1 at scale factor 1: 1.2 mm², "
      "12 s");
}

// A drum without images has an angle, and no area by which it differs.
TEST(Progress, TrialLinesHaveTheNumbersOfTheirTestInTheUnitsThatPeopleRead) {
  TrialProgress trial{.trial = 7,
                      .parameters = {"sliding_friction"},
                      .values = {0.3},
                      .experiment = "mixer",
                      .numbers = {{"angle_deg", 43.5}, {"mass_fallen_kg", 23e-6}},
                      .duration = 2};
  EXPECT_EQ(ProgressText(trial),
            "trial 7 (search) at sliding_friction 0.3, mixer at scale factor 1: angle 43.5°, mass "
            "fallen 23 mg, 2 s");
  trial.numbers.clear();
  EXPECT_EQ(ProgressText(trial),
            "trial 7 (search) at sliding_friction 0.3, mixer at scale factor 1: "
            "what was measured is not defined of it, 2 s");
}

// Into a file, as a cluster or `nohup` has it, a line now and then; on a terminal it is one line
// that changes.
TEST(Progress, WhereNoTerminalIsTheStatusIsALineNowAndThen) {
  const CampaignProgress progress{.used = "7 of 60 simulations", .seconds_left = 170};
  const auto said = [&](std::chrono::steady_clock::duration period) {
    testing::internal::CaptureStderr();
    Console console(std::filesystem::path(testing::TempDir()) / "console.log",
                    Console::Output::kStandardError, period);
    console.Status(progress);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(std::chrono::seconds(0)), ProgressText(progress) + "\n");
  EXPECT_EQ(said(std::chrono::hours(1)), "");
}

TEST(Progress, SaysWhatIsUsedAndWhatIsLeft) {
  EXPECT_EQ(ProgressText(CampaignProgress{.used = "7 of 60 simulations",
                                          .num_running = 2,
                                          .best = 1.2,
                                          .best_trial = 5,
                                          .unit = "mm²",
                                          .seconds_left = 170}),
            "7 of 60 simulations, 2 running, best 1.2 mm² (trial 5), at most 3 min left");
}

}  // namespace budget_use_test
}  // namespace talus::campaign
