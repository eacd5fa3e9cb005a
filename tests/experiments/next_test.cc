#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/analysis/next/rank_next.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {
namespace {

using campaign::FakeEngine;
using campaign::JointView;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Two scale factors; what falls off the plate tells μ_t, and nobody has weighed it.
class NextTest : public campaign::CampaignFixture {
 protected:
  JointView Run(const std::string& more = "") {
    folder_ = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 24}, "confirm": {"candidates": 0}, "workers": 1)" +
                    more);
    campaign::RunFake(folder_, {});
    return campaign::ReadJointView(folder_);
  }
  static NextTable Rank(const JointView& view, std::vector<TestCandidate> tests, bool simulate) {
    NextOptions options{.tests = std::move(tests), .simulate = simulate};
    options.parts = {.runner = campaign::MakeRunner(view.spec, view.folder.root),
                     .engine = std::make_unique<FakeEngine>(campaign::FakeEngineOptions{})};
    return RankNext(view, options);
  }
  static const NextCandidate& Find(const NextTable& table, const std::string& name) {
    for (const NextCandidate& c : table.candidates) {
      if (c.name == name) return c;
    }
    throw base::Error("no candidate " + name);
  }
  fs::path folder_;
};

TEST_F(NextTest, RanksWhatTrialsAlreadyTellAndAsksForTheOthers) {
  const JointView view = Run();
  const NextTable table = Rank(view, UsualTests(view), false);
  ASSERT_EQ(table.candidates.size(), 3u + 3u);
  const NextCandidate& mass = Find(table, "mass fallen of heap");
  const NextCandidate& runs = Find(table, "more runs of heap");
  EXPECT_GT(mass.learning->bits, runs.learning->bits);
  EXPECT_GT(runs.learning->bits, 0);
  // A mass that falls with μ_t narrows its range.
  EXPECT_LT(mass.learning->width[0], table.width[0]);
  EXPECT_EQ(mass.num_simulations, 0);
  EXPECT_FALSE(Find(table, "wide plate, 5 cm/s").learning.has_value());
  EXPECT_GT(Find(table, "wide plate, 5 cm/s").core_time, 0);
  EXPECT_THAT(NextText(table), HasSubstr("--simulate"));
  EXPECT_FALSE(fs::exists(folder_ / "next")) << "looking must not write";
}

TEST_F(NextTest, ADesignIsSimulatedOnceAndShowsTheSetsThatItTellsApart) {
  const JointView view = Run();
  const std::vector<TestCandidate> tests{{.name = "again: slowly!"}};
  const NextTable table = Rank(view, tests, true);
  const NextCandidate& again = Find(table, "again: slowly!");
  ASSERT_TRUE(again.learning.has_value());
  EXPECT_GT(again.learning->bits, 0);
  EXPECT_EQ(again.picture, folder_ / "next" / "again-slowly-.png");
  EXPECT_TRUE(fs::exists(again.picture));
  ASSERT_EQ(again.apart.size(), 2u);
  const auto time = fs::last_write_time(folder_ / "next/again-slowly-/trials/0001/profile.png");
  const NextTable later = Rank(view, tests, false);
  EXPECT_EQ(Find(later, again.name).learning->bits, again.learning->bits);
  EXPECT_EQ(fs::last_write_time(folder_ / "next/again-slowly-/trials/0001/profile.png"), time);
  EXPECT_THAT(NextJson(later), HasSubstr("\"told_apart\""));
}

TEST_F(NextTest, ADesignOfAnotherDeviceIsNotTakenForThis) {
  const JointView view = Run();
  TestCandidate test{.name = "fast"};
  test.device = view.spec.device;
  test.device->lift_velocity = 0.1;
  Rank(view, {test}, true);
  test.device->lift_velocity = 0.2;
  EXPECT_FALSE(Find(Rank(view, {test}, false), "fast").learning.has_value());
}

TEST_F(NextTest, CandidatesComeFromAFile) {
  const fs::path file = scratch_.path() / "tests.json";
  std::ofstream(file) << R"({"candidates": [{"name": "fast", "device": {"lift_velocity": "20 cm/s"},
                                             "runs": 5}]})";
  const std::vector<TestCandidate> tests = LoadTests(file);
  ASSERT_EQ(tests.size(), 1u);
  EXPECT_EQ(tests[0].runs, 5);
  EXPECT_EQ(tests[0].device.value().lift_velocity, 0.2);
  std::ofstream(file) << R"({"candidates": [{"runs": 0}]})";
  EXPECT_THROW(LoadTests(file), base::ConfigError);
}

TEST_F(NextTest, TooFewTrialsForAPosteriorAreSaid) {
  const fs::path folder = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]},
    "budget": {"simulations": 3}, "confirm": {"candidates": 0}, "workers": 1)");
  campaign::RunFake(folder, {});
  EXPECT_THROW(Rank(campaign::ReadJointView(folder), {}, false), base::Error);
}

}  // namespace
}  // namespace talus::analysis
