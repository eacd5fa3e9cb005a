// Campaigns that end when a prediction is known well enough, with drawn heaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/json/json_writer.h"
#include "experiments/analysis/next/campaign_goal.h"
#include "experiments/campaign/add_experiment.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/rigs/case/run_files.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/two_experiments.h"

namespace talus::analysis {
namespace goal_test {

using campaign::FakeEngine;
using campaign::GoalState;
using optimizer::StopRule;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class GoalTest : public campaign::CampaignFixture {
 protected:
  // Tapped density is 1550 − 350 μ_r kg/m³, and scatters by less than what the heap leaves of it:
  // its model error is large, so that few simulations show what it can tell.
  fs::path WithGoal(const std::string& half_width, const std::string& name = "run",
                    const std::string& observable = "tapped_density",
                    const std::string& rig = R"({"kind": "tapped_density", "diameter": "10 mm"})") {
    fs::create_directories(scratch_.path() / (name + "_in"));
    std::ofstream(scratch_.path() / (name + "_in") / "taps.json")
        << R"({"powder": {"material": {"density": 2500},
             "sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g"},
             "filling": {"kind": "pour"}, "rig": )"
        << rig << "}";
    return Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]}, "workers": 1,
      "posterior": {"stop_share": 0, "model_error": 5}, "budget": {"simulations": 80},
      "confirm": {"candidates": 0}, "goal": {"case": "taps.json", "observable": ")" +
                     observable + R"(", "half_width": ")" + half_width + "\"}",
                 name);
  }
  static campaign::CampaignEnd Run(
      const fs::path& folder, const campaign::FakeEngineOptions& of_goal = {.density_scatter = 0.3},
      const campaign::ResumeOptions& options = {}) {
    const base::InterruptGuard interrupt;
    campaign::Console console(folder / "campaign.log", campaign::Console::Output::kQuiet);
    campaign::OpenedCampaign opened = campaign::OpenCampaign(folder, options, console);
    const auto parts = [&](const campaign::FakeEngineOptions& engine) {
      return campaign::CampaignParts{
          .runner = campaign::MakeDrawnRunner(opened.spec, opened.folder.root),
          .engine = std::make_unique<FakeEngine>(engine)};
    };
    campaign::CampaignParts own = parts({.density_scatter = 0.3});
    own.goal = std::make_unique<CampaignGoal>(opened.spec, folder, parts(of_goal));
    campaign::Campaign campaign(opened.folder, std::move(opened.lock), std::move(opened.journal),
                                opened.spec, std::move(own), console);
    return campaign.Run(interrupt);
  }
  // The folder of a search that has not ended yet.
  static void Reopen(const fs::path& folder) {
    campaign::Console console(folder / "campaign.log", campaign::Console::Output::kQuiet);
    campaign::OpenedCampaign opened = campaign::OpenCampaign(folder, {}, console);
    opened.journal.ReopenSearch();
    fs::remove(folder / "result.json");
  }
  // As if each run of the first look had taken so long [s].
  static void SetTimeOfFirstLook(const fs::path& folder, const std::string& seconds) {
    for (const auto& run : fs::directory_iterator(campaign::GoalLooks(folder).at(0) / "trials")) {
      if (run.is_directory()) base::WriteFileAtomically(run.path() / rigs::kTookFile, seconds);
    }
  }
  static std::optional<GoalState> Last(const fs::path& folder) {
    return campaign::LastGoal(folder, campaign::ReadJointView(folder).spec);
  }
};

TEST_F(GoalTest, EndsTheSearchWhenItIsKnownAsWellAsAsked) {
  const fs::path folder = WithGoal("100 kg/m^3");
  EXPECT_EQ(Run(folder), campaign::CampaignEnd::kFinished);
  const auto answer = Result(folder);
  ASSERT_TRUE(answer.stop.rule.has_value()) << answer.stop.Text();
  EXPECT_EQ(answer.stop.rule->rule, StopRule::kGoal);
  EXPECT_EQ(answer.stop.rule->limit, 100);
  EXPECT_LE(answer.stop.rule->value, 100);
  EXPECT_THAT(answer.stop.Text(), HasSubstr("tapped density of taps, in kg/m³, is known to ± "));
  EXPECT_LT(Trials(folder).size(), 40u);
  const auto goal = Last(folder);
  ASSERT_TRUE(goal.has_value());
  EXPECT_EQ(goal->num_runs, 8);
  EXPECT_EQ(goal->after, static_cast<std::int64_t>(Trials(folder).size()));
}

// They were made anew at each look, and nothing was said.
TEST_F(GoalTest, RunsThatAllFailAreMadeOnceAndTheReasonIsSaid) {
  const fs::path folder = WithGoal("100 kg/m^3");
  Run(folder, {.fail_first = 1000});
  EXPECT_EQ(campaign::GoalLooks(folder).size(), 1u);
  const GoalState last = Last(folder).value();
  EXPECT_EQ(last.num_runs, 0);
  EXPECT_THAT(last.failure, HasSubstr("none has ended well"));
  EXPECT_THAT(base::ReadFile(folder / "campaign.log"), HasSubstr("none has ended well"));
  EXPECT_THAT(campaign::TextOf(last, *campaign::ReadJointView(folder).spec.goal),
              HasSubstr("0 runs of it: none has ended well"));
}

// What was known without it is no reason to end the search, and its runs are paid for already.
TEST_F(GoalTest, ATestThatIsAddedAfterwardsIsSimulated) {
  const fs::path folder = WithGoal("100 kg/m^3");
  EXPECT_EQ(Run(folder), campaign::CampaignEnd::kFinished);
  ASSERT_TRUE(Last(folder)->reason.has_value());
  const fs::path file = scratch_.path() / "run_in" / "second.json";
  std::ofstream(file) << campaign::TwoExperiments::FastLift("23 mg");
  {
    campaign::Console console(folder / "campaign.log", campaign::Console::Output::kQuiet);
    campaign::AddExperiment(folder, file, {.core_time = 0.3}, console);
  }
  EXPECT_FALSE(Last(folder)->reason.has_value());
  const campaign::CampaignSpec spec = campaign::ReadJointView(folder).spec;
  EXPECT_EQ(campaign::NextLook(Last(folder), spec),
            std::min(campaign::NextLook(Last(folder)->after), Last(folder)->after + 16));
  campaign::CoreTime former(spec);
  EXPECT_NEAR(spec.budget.core_time.value(),
              former.OfSearch(Trials(folder)) + Last(folder)->core_time + 0.3, 1e-9);
  EXPECT_EQ(Run(folder), campaign::CampaignEnd::kFinished);
  EXPECT_GE(std::ranges::count(Trials(folder), 1, &journal::TrialRecord::experiment), 6);
}

// Its runs have points of another length then, and say nothing; their time vanished with that.
TEST_F(GoalTest, RunsBeforeAParameterWasAddedStayInTheCost) {
  const fs::path folder = WithGoal("100 kg/m^3");
  Run(folder);
  SetTimeOfFirstLook(folder, "100");
  EXPECT_GE(Last(folder)->core_time, 800);
  campaign::ResumeOptions options;
  options.search = {"restitution=0.3..0.95"};
  ASSERT_EQ(Run(folder, {.density_scatter = 0.3}, options), campaign::CampaignEnd::kFinished);
  ASSERT_GT(campaign::GoalLooks(folder).size(), 1u);
  EXPECT_EQ(Last(folder)->num_parameters, 3);
  EXPECT_GE(Last(folder)->core_time, 800);
  EXPECT_GE(3600 * Result(folder).cost.core_hours, 800);
}

TEST_F(GoalTest, RunsOfAGoalThatIsNoLongerAskedForStayInTheCost) {
  const fs::path folder = WithGoal("100 kg/m^3");
  Run(folder);
  SetTimeOfFirstLook(folder, "100");
  nlohmann::ordered_json spec =
      nlohmann::ordered_json::parse(base::ReadFile(scratch_.path() / "run_in" / "spec.json"));
  spec.erase("goal");
  campaign::ResumeOptions options;
  options.spec = scratch_.path() / "run_in" / "without.json";
  std::ofstream(options.spec) << spec;
  ASSERT_EQ(campaign::RunFake(folder, {}, options), campaign::CampaignEnd::kFinished);
  EXPECT_GE(3600 * Result(folder).cost.core_hours, 800);
}

// A look whose design is not there, or is that of another process, is made anew in its place.
TEST_F(GoalTest, RunsThatAreReplacedStayInTheCost) {
  const fs::path folder = WithGoal("100 kg/m^3");
  Run(folder);
  SetTimeOfFirstLook(folder, "100");
  const fs::path look = campaign::GoalLooks(folder).at(0);
  fs::remove(look / "goal.json");
  fs::remove(look / "design.json");
  Reopen(folder);
  ASSERT_EQ(Run(folder), campaign::CampaignEnd::kFinished);
  ASSERT_TRUE(fs::exists(look / "design.json"));
  EXPECT_GE(Last(folder)->core_time, 800);
  EXPECT_LT(Last(folder)->core_time, 1000);  // once
  EXPECT_GE(3600 * Result(folder).cost.core_hours, 800);
}

// What the heap leaves open of μ_r stays open whatever is simulated, and so does the density.
TEST_F(GoalTest, EndsTheSearchWhenSimulationsCannotNarrowIt) {
  const fs::path folder = WithGoal("0.01 kg/m^3");
  EXPECT_EQ(Run(folder), campaign::CampaignEnd::kFinished);
  const auto answer = Result(folder);
  const GoalState last = Last(folder).value();
  ASSERT_TRUE(answer.stop.rule.has_value())
      << answer.stop.Text() << ": sets " << last.parameters_half_width << ", surrogate "
      << last.surrogate_half_width << ", least " << last.least_half_width;
  EXPECT_EQ(answer.stop.rule->rule, StopRule::kGoalOpen);
  EXPECT_GT(answer.stop.rule->scale, 0.01);
  EXPECT_LE(answer.stop.rule->scale, answer.stop.rule->value);
}

// As if it had been killed while the goal's runs of the last look were made.
TEST_F(GoalTest, GoesOnWhereItWasEndedToTheSameTrials) {
  const fs::path whole = WithGoal("0.01 kg/m^3", "whole");
  Run(whole);
  const fs::path again = WithGoal("0.01 kg/m^3", "again");
  Run(again);
  ASSERT_EQ(Last(again)->half_width, Last(whole)->half_width);
  const fs::path look = campaign::GoalLooks(again).back();
  fs::remove(look / "goal.json");
  fs::remove_all(look / "trials/0002");
  Reopen(again);
  const auto time = fs::last_write_time(look / "trials/0001/profile.png");
  EXPECT_EQ(Run(again), campaign::CampaignEnd::kFinished);
  EXPECT_EQ(fs::last_write_time(look / "trials/0001/profile.png"), time);
  EXPECT_EQ(campaign::TrialTable(again), campaign::TrialTable(whole));
  EXPECT_EQ(Last(again)->half_width, Last(whole)->half_width);
  EXPECT_EQ(Result(again).stop.rule->value, Result(whole).stop.rule->value);
}

TEST_F(GoalTest, WhatItsCaseDoesNotMeasureIsRefusedBeforeAnythingIsWritten) {
  const auto error = [&](const std::string& name, const std::string& observable,
                         const std::string& rig) -> std::string {
    const fs::path folder = WithGoal("1", name, observable, rig);
    return ErrorIn([&] { CheckGoal(campaign::ReadJointView(folder).spec, {}); });
  };
  const std::string taps = R"({"kind": "tapped_density", "diameter": "10 mm"})";
  EXPECT_THAT(error("a", "hausner_ratio", taps), "");
  EXPECT_THAT(error("b", "coverage", taps), HasSubstr("it measures poured_density"));
  EXPECT_THAT(error("c", "hausner_ratio", R"({"kind": "tapped_density", "diameter": "1 mm"})"),
              HasSubstr("taps.json"));
  EXPECT_THROW(WithGoal("1", "d", "beauty", taps), base::ConfigError);
  EXPECT_THROW(WithGoal("-1", "e", "hausner_ratio", taps), base::ConfigError);
}

TEST(GoalLooks, StandFartherAndFartherApart) {
  std::vector<std::int64_t> looks;
  for (std::int64_t last = 0; looks.size() < 5; looks.push_back(last)) {
    last = campaign::NextLook(last);
  }
  EXPECT_EQ(looks, (std::vector<std::int64_t>{16, 24, 36, 54, 81}));
}

}  // namespace goal_test
}  // namespace talus::analysis
