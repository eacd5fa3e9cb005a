#include "experiments/campaign/reuse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "experiments/rigs/case/case_text.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/two_experiments.h"

namespace talus::campaign {
namespace reuse_test {

using ::testing::HasSubstr;
using ::testing::SizeIs;
namespace fs = std::filesystem;

constexpr const char* kFormer = R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 16}, "confirm": {"candidates": 1, "replicates": 2},
      "workers": 1)";
constexpr const char* kNew = R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 4}, "confirm": {"candidates": 1, "replicates": 2},
      "workers": 1)";

class ReuseTest : public CampaignFixture {
 protected:
  fs::path path(const std::string& name) const { return scratch_.path() / name; }

  // A campaign that has ended.
  fs::path Ended() const { return Finished(kFormer, {}, "former"); }
  fs::path WriteSpec(const std::string& name, const std::string& more = kNew) const {
    return WriteFakeSpec(path(name + "_in"), more);
  }
  // A campaign that begins with what others have simulated; what it says goes to said_.
  fs::path Reuse(const fs::path& spec, const std::string& name,
                 const std::vector<fs::path>& folders) {
    BeginOptions options{.reuse = folders};
    options.say = [this](const std::string& text) { said_ += text + "\n"; };
    options.engine = [] { return std::make_unique<FakeEngine>(FakeEngineOptions{}); };
    BeginCampaign(spec, path(name), options);
    return path(name);
  }
  std::string ErrorOf(const fs::path& spec, const std::vector<fs::path>& folders,
                      const std::string& name = "refused") {
    return ErrorIn([&] { Reuse(spec, name, folders); });
  }
  static std::vector<journal::TrialRecord> Reused(const fs::path& folder) {
    std::vector<journal::TrialRecord> trials = Trials(folder);
    std::erase_if(trials, [](const auto& t) { return t.kind != journal::TrialKind::kReused; });
    return trials;
  }

  std::string said_;
};

// All that succeeded, those of the confirmation too; the budget of 4 is for what comes after them,
// and no filling of theirs comes again.
TEST_F(ReuseTest, TheTrialsOfTheFormerCampaignAreToldFirst) {
  const fs::path former = Ended();
  const auto before = Trials(former);
  const fs::path folder = Reuse(WriteSpec("second"), "second", {former});
  EXPECT_THAT(said_, HasSubstr(std::to_string(before.size()) + " simulations told first"));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const auto after = Trials(folder);
  ASSERT_GT(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].kind, journal::TrialKind::kReused);
    EXPECT_EQ(after[i].status, journal::TrialStatus::kOk);
    EXPECT_EQ(after[i].origin, CampaignFolder{former}.trial(before[i].id));
    EXPECT_EQ(after[i].unit, before[i].unit);
    EXPECT_EQ(after[i].native, before[i].native);
    EXPECT_EQ(after[i].seed, before[i].seed);
    EXPECT_EQ(after[i].scale_factor, before[i].scale_factor);
    EXPECT_EQ(after[i].cpu_s, before[i].cpu_s);
    EXPECT_EQ(after[i].finish_order, static_cast<std::int64_t>(i) + 1);
  }
  EXPECT_EQ(std::ranges::count_if(after, &journal::TrialRecord::IsPaidFor), 4);
  std::vector<std::int64_t> seeds;
  for (const auto& trial : after) seeds.push_back(trial.seed);
  std::ranges::sort(seeds);
  EXPECT_EQ(std::ranges::adjacent_find(seeds), seeds.end());
  const Answer answer = Result(folder);
  EXPECT_EQ(answer.cost.num_trials, static_cast<int>(after.size() - before.size()));
  ASSERT_THAT(answer.reused, SizeIs(1));
  EXPECT_EQ(answer.reused[0].from, former);
  EXPECT_EQ(answer.reused[0].num_trials, static_cast<int>(before.size()));
  EXPECT_THAT(base::ReadFile(folder / "campaign.log"),
              HasSubstr("first answer, by what was reused: "
                        "sliding_friction"));
  // The strategy's rule, which counts what was reused, is not to end it before these are simulated.
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  const BudgetOptions more = OpenCampaign(folder, {.add_simulations = 5}, console).spec.budget;
  EXPECT_EQ(more.simulations, 9);
  EXPECT_EQ(more.min_simulations, 9 + static_cast<int>(before.size()));
}

TEST_F(ReuseTest, EqualSpecsAndFoldersGiveEqualBits) {
  const fs::path former = Ended();
  const fs::path first = Reuse(WriteSpec("second"), "second", {former});
  const fs::path again = Reuse(WriteSpec("third"), "third", {former});
  RunFake(first, {});
  RunFake(again, {});
  EXPECT_EQ(TrialTable(first), TrialTable(again));
}

// Whatever of BeginCampaign a kill has left out, once the campaign's record is there.
TEST_F(ReuseTest, AKilledBeginningIsFinishedWithoutTheFormerFolder) {
  const fs::path former = Ended();
  const fs::path whole = Reuse(WriteSpec("second"), "second", {former});
  const fs::path killed = Reuse(WriteSpec("third"), "third", {former});
  fs::remove_all(former);
  for (const char* suffix : {"", "-wal", "-shm"}) {
    fs::remove(journal::JournalPath(killed).string() + suffix);
  }
  fs::create_directories(killed / kCopiesFolder);
  fs::rename(killed / "trials", killed / kCopiesFolder / "trials");
  RunFake(whole, {});
  RunFake(killed, {});
  EXPECT_EQ(TrialTable(whole), TrialTable(killed));
  EXPECT_FALSE(fs::exists(killed / kCopiesFolder));
}

// Before there is a campaign the same command begins again, and takes nothing that was half copied.
TEST_F(ReuseTest, CopiesWithoutACampaignAreClearedAway) {
  fs::create_directories(path("second") / kCopiesFolder / "trials/0001");
  std::ofstream(path("second") / kCopiesFolder / "trials/0001/trial.json") << "half";
  const fs::path folder = Reuse(WriteSpec("second"), "second", {});
  EXPECT_THAT(Trials(folder), SizeIs(0));
  EXPECT_FALSE(fs::exists(folder / kCopiesFolder));
}

TEST_F(ReuseTest, ATrialThatSeveralFoldersHoldIsToldOnce) {
  const fs::path former = Ended();
  const fs::path second = Reuse(WriteSpec("second"), "second", {former});
  RunFake(second, {});
  const fs::path third = Reuse(WriteSpec("third"), "third", {former, second});
  EXPECT_EQ(Reused(third).size(), Trials(second).size());
  EXPECT_THAT(said_, HasSubstr("left out: " + std::to_string(Trials(former).size()) +
                               " that were taken already"));
}

TEST_F(ReuseTest, TrialsOutsideTheNewRangesAreLeftOutAndCounted) {
  const fs::path former = Ended();
  const fs::path spec = WriteSpec("second");
  std::string text = base::ReadFile(spec);
  text.replace(text.find("\"max\": 0.8"), 10, "\"max\": 0.5");
  std::ofstream(spec) << text;
  const fs::path folder = Reuse(spec, "second", {former});
  const auto trials = Trials(former);
  const auto outside =
      std::ranges::count_if(trials, [](const auto& t) { return t.native[0] > 0.5; });
  ASSERT_GT(outside, 0);
  EXPECT_EQ(Reused(folder).size() + static_cast<std::size_t>(outside), trials.size());
  EXPECT_THAT(said_, HasSubstr(std::to_string(outside) + " outside the ranges here"));
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  for (const auto& trial : Reused(folder)) {
    EXPECT_EQ(trial.status, journal::TrialStatus::kOk);
    EXPECT_NEAR(trial.unit[0], (trial.native[0] - 0.1) / 0.4, 1e-12);
  }
}

TEST_F(ReuseTest, AnExperimentThatWasNotThereIsSimulated) {
  const fs::path former = Ended();
  const fs::path spec = WriteSpec("both");
  std::string text = base::ReadFile(spec);
  const auto begin = text.find("\"experiment\"");
  text.replace(begin, text.find("\"powder\"") - begin,
               std::string(R"("experiments": [{"name": "heap", )") + TwoExperiments::kMap + "}, " +
                   TwoExperiments::FastLift("23 mg") + "],\n");
  const std::string budget = "\"simulations\": 4";
  text.replace(text.find(budget), budget.size(), "\"simulations\": 10");
  std::ofstream(spec) << text;
  const fs::path folder = Reuse(spec, "both", {former});
  EXPECT_THAT(said_, HasSubstr("nothing for \"fast lift\": of \"heap\" there, device.lift_velocity "
                               "is 0.01 there and 0.2 here"));
  for (const auto& trial : Reused(folder)) EXPECT_EQ(trial.experiment, 0);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const auto trials = Trials(folder);
  EXPECT_GE(std::ranges::count_if(trials, [](const auto& t) { return t.experiment == 1; }), 8);
  EXPECT_THAT(Result(folder).posterior.value().experiments, SizeIs(2));
}

TEST_F(ReuseTest, WhatDoesNotMatchIsRefusedWithTheFirstKeyAndNothingIsWritten) {
  const fs::path former = Ended();
  const auto refuses = [&](const std::string& from, const std::string& to,
                           const std::string& reason) {
    const fs::path spec = WriteSpec("other");
    std::string text = base::ReadFile(spec);
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), from.size(), to);
    std::ofstream(spec) << text;
    EXPECT_THAT(ErrorOf(spec, {former}), HasSubstr(reason));
    EXPECT_FALSE(fs::exists(path("refused"))) << to;
  };
  refuses(R"("mass": "0.5 g")", R"("mass": "0.6 g")",
          "powder.mass is 0.0005 there and 0.0006 here");
  refuses(R"("mass": "0.5 g")", R"("mass": "0.501 g")", "what differs a little is refused as well");
  refuses(R"("density": 2500)", R"("density": 2500, "restitution": 0.5)",
          "powder.material.restitution is");
  refuses(R"("workers": 1)", R"("workers": 1, "gravity": 1.62)", "gravity is 9.81 there and 1.62");
  refuses(R"("rolling_friction": {"min": 0.05, "max": 0.5})",
          R"("rolling_friction": {"fixed": 0.1})",
          "searched there: sliding_friction, rolling_friction; here: sliding_friction");
  refuses("[2, 1]", "[1.5, 1.2]", "at scale factors that are not searched here");
}

// Grains of 0.4 mm at scale factors 2 and 1 are those of 0.2 mm at 4 and 2: another fidelity of the
// same model.
TEST_F(ReuseTest, GrainsOfAnotherSizeAreThoseOfAnotherScaleFactor) {
  const fs::path former = Ended();
  const auto finer = [&](const std::string& levels) {
    const fs::path spec = WriteSpec("finer");
    std::string text = base::ReadFile(spec);
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"0.4 mm", "0.2 mm"},
                                   {"\"scale_factors\": [2, 1]", levels}}) {
      text.replace(text.find(from), from.size(), to);
    }
    std::ofstream(spec) << text;
    return spec;
  };
  const fs::path folder = Reuse(finer(R"("scale_factors": [4, 2, 1.5])"), "finer", {former});
  const auto before = Trials(former);
  const auto reused = Reused(folder);
  ASSERT_EQ(reused.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(reused[i].scale_factor, 2 * before[i].scale_factor);
  }
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  for (const auto& trial : Reused(folder)) EXPECT_EQ(trial.status, journal::TrialStatus::kOk);
  EXPECT_THAT(ErrorOf(finer(R"("scale_factors": [3, 1.5])"), {former}),
              HasSubstr("its grains are those of scale factor"));
}

TEST(RunDifference, GrainsOfAnotherSizeWerePouredAtAnotherRateUnlessOneIsStated) {
  rigs::Case there;
  there.powder.sizes.diameter = 1e-3;
  there.filling.kind = rigs::FillingKind::kPour;
  rigs::Case here = there;
  here.powder.sizes.diameter = 0.5e-3;
  here.coarse_graining.scale_factor = 2;
  EXPECT_THAT(rigs::RunDifference(there, here).value_or(""), HasSubstr("at their own rate"));
  there.filling.rate = here.filling.rate = 1e-3;
  EXPECT_EQ(rigs::RunDifference(there, here), std::nullopt);
}

// The others choose their first sets by what they have been told, and would leave them out.
TEST_F(ReuseTest, TrialsOfAnotherEngineAreRefusedAsSuch) {
  const fs::path former = Ended();
  fs::create_directories(path("deck"));
  std::ofstream(path("deck") / "run.sh") << "{{ sliding_friction }} {{ rolling_friction }}";
  const fs::path spec = WriteSpec("foreign", std::string(kNew) + R"(, "engine": {"kind": "command",
      "command": ["sh", "run.sh"], "templates": ")" +
                                                 path("deck").string() + "\"}");
  EXPECT_THAT(ErrorOf(spec, {former}),
              HasSubstr("it was run by talus itself; here another engine simulates"));
}

TEST_F(ReuseTest, AnotherStrategyIsRefused) {
  const fs::path former = Ended();
  EXPECT_THAT(ErrorOf(WriteSpec("other", R"(, "strategy": {"kind": "gp"})"), {former}),
              HasSubstr("--reuse: strategy.kind must be"));
}

TEST_F(ReuseTest, FoldersThatCannotBeReusedAreNamed) {
  const fs::path spec = WriteSpec("second");
  EXPECT_THAT(ErrorOf(spec, {path("nowhere")}), HasSubstr("nowhere: is neither the folder"));
  EXPECT_THAT(ErrorOf(spec, {path("second_in")}), HasSubstr("second_in: is neither the folder"));
  EXPECT_THAT(ErrorOf(spec, {path("refused")}), HasSubstr("is the new campaign's own folder"));
  EXPECT_FALSE(fs::exists(path("refused")));
}

// It is read as far as it has come.
TEST_F(ReuseTest, ACampaignThatAnotherProcessWorksOnIsSaidToBe) {
  const fs::path former = Ended();
  const CampaignLock lock(former);
  Reuse(WriteSpec("second"), "second", {former});
  EXPECT_THAT(said_, HasSubstr("former: another process works on it"));
}

}  // namespace reuse_test
}  // namespace talus::campaign
