#include "experiments/campaign/add_experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/analysis/next/rank_next.h"
#include "experiments/campaign/plan/campaign_strategy.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/two_experiments.h"

namespace talus::campaign {
namespace add_experiment_test {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr const char* kOne = R"(, "coarse_graining": {"scale_factors": [2, 1]},
      "budget": {"simulations": 16}, "confirm": {"candidates": 1, "replicates": 2},
      "workers": 1)";

class AddExperimentTest : public CampaignFixture {
 protected:
  // A campaign with one experiment that has ended.
  fs::path Ended(const std::string& extra = "") const {
    WriteFakeSpec(scratch_.path() / "run_in", kOne + extra);
    return Finished(kOne + extra);
  }
  static CampaignSpec LoadSpec(const fs::path& folder) {
    return ParseSpecText(
        journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_json);
  }
  // An entry of `experiments` beside the campaign's own input.
  fs::path Write(const std::string& text) const {
    const fs::path file = scratch_.path() / "run_in" / "second.json";
    std::ofstream(file) << text;
    return file;
  }
  static void Add(const fs::path& folder, const fs::path& file, const AddOptions& options = {}) {
    Console console(folder / "campaign.log", Console::Output::kQuiet);
    AddExperiment(folder, file, options, console);
  }
  // `talus next` simulates the design of a lifted tube that is drawn up so fast.
  void SimulateNext(const fs::path& folder, const std::string& velocity) const {
    const fs::path candidates = scratch_.path() / "candidates.json";
    std::string name = "lift " + velocity;
    std::replace(name.begin(), name.end(), '/', ' ');  // a name has no slash
    std::ofstream(candidates) << R"({"candidates": [{"name": ")" << name
                              << R"(", "device": {"lift_velocity": ")" << velocity << R"("}}]})";
    const JointView view = ReadJointView(folder);
    analysis::RankNext(view,
                       {.tests = analysis::LoadTests(candidates),
                        .simulate = true,
                        .parts = {.runner = MakeDrawnRunner(LoadSpec(folder), folder),
                                  .engine = std::make_unique<FakeEngine>(FakeEngineOptions{})}});
  }
  void AddFastLift(const fs::path& folder) const {
    Add(folder, Write(TwoExperiments::FastLift("23 mg")),
        {.core_time = {},
         .engine = [] { return std::make_unique<FakeEngine>(FakeEngineOptions{}); }});
  }
  static int Count(const fs::path& folder, int experiment) {
    const auto trials = Trials(folder);
    return static_cast<int>(std::count_if(trials.begin(), trials.end(), [&](const auto& t) {
      return t.experiment == experiment && t.IsOfSearch();
    }));
  }
};

TEST_F(AddExperimentTest, TheTrialsStayAndTheAnswerMeetsBoth) {
  const fs::path folder = Ended();
  const auto before = Trials(folder);
  // A busy machine, and a sanitizer, take several times as much core time for a trial as was used.
  Add(folder, Write(TwoExperiments::FastLift("23 mg")), {.core_time = 0.35});
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const auto after = Trials(folder);
  ASSERT_GT(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].experiment, 0);
    EXPECT_EQ(after[i].unit, before[i].unit);
  }
  EXPECT_GE(Count(folder, 1), 6);
  const Answer result = Result(folder);
  ASSERT_EQ(result.posterior.value().experiments.size(), 2u);
  EXPECT_EQ(result.posterior->experiments[0].name, "heap");
  EXPECT_EQ(result.posterior->experiments[1].name, "fast lift");
  EXPECT_EQ(result.confirmed.at(0).experiments.size(), 2u);
}

// The spec's file does not know of what the campaign was given since.
TEST_F(AddExperimentTest, ASpecThatIsChangedLaterLeavesItThere) {
  const fs::path folder = Begin(kOne);
  RunFake(folder, {});
  Add(folder, Write(TwoExperiments::FastLift("23 mg")), {.core_time = 0.35});
  const CampaignSpec added = LoadSpec(folder);
  const fs::path file =
      journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_path;
  std::string text = base::ReadFile(file);
  const auto change = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), from.size(), to);
    std::ofstream(file) << text;
  };
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  change(R"("workers": 1)", R"("workers": 2)");
  const CampaignSpec with_workers = OpenCampaign(folder, {}, console).spec;
  ASSERT_EQ(ExperimentsOf(with_workers).size(), 2u);
  EXPECT_EQ(ExperimentsOf(with_workers)[1].name, "fast lift");
  EXPECT_EQ(with_workers.workers, 2);
  EXPECT_EQ(with_workers.budget.core_time, added.budget.core_time);
  change(R"({"simulations": 16})", R"({"simulations": 40})");
  const CampaignSpec with_more = OpenCampaign(folder, {}, console).spec;
  EXPECT_EQ(ExperimentsOf(with_more).size(), 2u);
  EXPECT_EQ(with_more.budget.simulations, 40);
  EXPECT_FALSE(with_more.budget.core_time);
  // Kept in step, the file lists both.
  nlohmann::json both = base::ParseJson(text, file.string()).root;
  both["experiment"]["name"] = ExperimentsOf(added)[0].name;
  both["experiments"] = {both["experiment"],
                         nlohmann::json::parse(TwoExperiments::FastLift("23 mg"))};
  both.erase("experiment");
  both["workers"] = 3;
  std::ofstream(file) << both.dump(1);
  const CampaignSpec in_step = OpenCampaign(folder, {}, console).spec;
  EXPECT_EQ(ExperimentsOf(in_step).size(), 2u);
  EXPECT_EQ(in_step.workers, 3);
  // From then on no edit of it was taken, nor the first list.
  both["budget"] = {{"simulations", 50}};
  std::ofstream(file) << both.dump(1);
  EXPECT_EQ(OpenCampaign(folder, {}, console).spec.budget.simulations, 50);
  change(R"({"simulations": 40})", R"({"simulations": 60})");
  const CampaignSpec first = OpenCampaign(folder, {}, console).spec;
  EXPECT_EQ(ExperimentsOf(first).size(), 2u);
  EXPECT_EQ(first.budget.simulations, 60);
  both["experiments"][1]["device"]["lift_velocity"] = "30 cm/s";
  std::ofstream(file) << both.dump(1);
  EXPECT_THAT(ErrorIn([&] { OpenCampaign(folder, {}, console); }),
              HasSubstr("experiments[1].device.lift_velocity: "));
}

// What was left of its budget was thrown away, and one without a trial had a budget of 0 s.
TEST_F(AddExperimentTest, ACampaignThatHasNotEndedKeepsItsBounds) {
  const fs::path folder = Begin(R"(, "workers": 1,
      "budget": {"simulations": 60, "min_simulations": 60, "wall_clock": "1 h"})");
  Add(folder, Write(TwoExperiments::FastLift("23 mg")));
  const BudgetOptions counted = LoadSpec(folder).budget;
  EXPECT_EQ(counted.simulations, 76);
  EXPECT_EQ(counted.min_simulations, 60);
  EXPECT_EQ(counted.wall_clock, 3600);
  EXPECT_FALSE(counted.core_time);
  const fs::path timed = Begin(R"(, "workers": 1, "budget": {"core_time": "1 h"})", "timed");
  Add(timed, Write(TwoExperiments::FastLift("23 mg")), {.core_time = 600});
  EXPECT_EQ(LoadSpec(timed).budget.core_time, 4200);
  EXPECT_EQ(LoadSpec(timed).budget.simulations, 0);
}

// A trial that still runs when the budget is used counts by an estimate; where it takes less, the
// budget has room again.
TEST_F(AddExperimentTest, ACampaignThatHasEndedWithItDoesNotSearchOnByItself) {
  const fs::path folder = Ended();
  Add(folder, Write(TwoExperiments::FastLift("23 mg")), {.core_time = 0.2});
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const auto ended = Trials(folder);
  {
    auto journal = journal::Journal::Open(journal::JournalPath(folder));
    CampaignSpec spec = LoadSpec(folder);
    *spec.budget.core_time *= 2;
    journal::CampaignRecord record = journal.Campaign();
    record.spec_json = SpecText(spec);
    journal.SetSpec(record);
  }
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(Trials(folder).size(), ended.size());
  EXPECT_EQ(Result(folder).stop.kind, StopKind::kCoreTime);
  EXPECT_EQ(RunFake(folder, {}, {.add_simulations = 2}), CampaignEnd::kFinished);
  EXPECT_GE(Trials(folder).size(), ended.size() + 2);
}

// The design stands 16 simulations; none of them is run again, and nothing of the usual design of
// an added test beside them.
TEST_F(AddExperimentTest, WhatNextHasSimulatedOfTheTestIsTakenOver) {
  const fs::path folder = Ended();
  const auto before = Trials(folder);
  SimulateNext(folder, "0.1 m/s");  // another test
  SimulateNext(folder, "20 cm/s");
  AddFastLift(folder);
  const auto taken = Trials(folder);
  ASSERT_EQ(taken.size(), before.size() + 16);
  const std::string drawn = base::ReadFile(folder / "next/lift-20-cm-s/trials/0003/profile.png");
  EXPECT_EQ(
      base::ReadFile(CampaignFolder{folder}.trial(taken[before.size() + 2].id) / "profile.png"),
      drawn);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const auto after = Trials(folder);
  for (std::size_t i = before.size(); i < before.size() + 16; ++i) {
    EXPECT_EQ(after[i].experiment, 1);
    EXPECT_EQ(after[i].status, journal::TrialStatus::kOk);
    EXPECT_EQ(after[i].unit, taken[i].unit);
  }
  for (std::size_t i = before.size() + 16; i < after.size(); ++i) {
    EXPECT_NE(after[i].kind, journal::TrialKind::kDesign);
  }
  EXPECT_EQ(Result(folder).posterior.value().experiments.size(), 2u);
}

TEST_F(AddExperimentTest, WhatIsTakenOverGetsNoReplicates) {
  const fs::path folder = Ended(R"(, "replicates": 2)");
  const std::size_t num_before = Trials(folder).size();
  SimulateNext(folder, "20 cm/s");
  AddFastLift(folder);
  const std::size_t num_taken = Trials(folder).size() - num_before;
  ASSERT_EQ(num_taken, 16u);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  std::map<std::int64_t, int> members;
  for (const journal::TrialRecord& trial : Trials(folder)) {
    if (trial.experiment == 1 && trial.IsOfSearch()) ++members[trial.set];
  }
  const auto size = [](const auto& group) { return group.second; };
  EXPECT_EQ(std::ranges::count(members, 1, size), 16);
  EXPECT_EQ(std::ranges::count_if(
                members, [](int num) { return num > 2; }, size),
            0);
}

TEST_F(AddExperimentTest, ItIsStillThereInAJournalThatIsMadeAnew) {
  const fs::path folder = Ended();
  Add(folder, Write(TwoExperiments::FastLift("23 mg")));
  RunFake(folder, {});
  const std::string table = TrialTable(folder);
  fs::resize_file(journal::JournalPath(folder), 5000);
  RunFake(folder, {});
  EXPECT_EQ(TrialTable(folder), table);
}

// An estimate can be wrong by a factor of fifty, and the search with the new test would take as
// much.
TEST_F(AddExperimentTest, AJournalThatIsMadeAnewKnowsWhatItsTrialsHaveCost) {
  const fs::path folder = Ended();
  const auto cost = [&] {
    double sum = 0;
    for (const journal::TrialRecord& trial : Trials(folder)) sum += trial.cpu_s;
    return sum;
  };
  const double before = cost();
  EXPECT_GT(before, 0);
  fs::resize_file(journal::JournalPath(folder), 5000);
  RunFake(folder, {});
  EXPECT_EQ(cost(), before);
}

// 600 trials were spent on a number that none of them left.
TEST_F(AddExperimentTest, ANumberThatTheEngineDoesNotLeaveStopsTheSearchAtItsFirstTrial) {
  const fs::path folder = Ended();
  Add(folder, Write(TwoExperiments::FastLift("23 mg")), {.core_time = 10});
  try {
    RunFake(folder, {.no_numbers = true});
    ADD_FAILURE() << "it went on";
  } catch (const base::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("leaves no number"));
  }
  const auto after = Trials(folder);
  EXPECT_EQ(std::ranges::count(after, 1, &journal::TrialRecord::experiment), 1);
}

TEST_F(AddExperimentTest, WhatCannotBeAddedChangesNothing) {
  const fs::path folder = Ended();
  const std::string spec =
      journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_json;
  const std::string kept = base::ReadFile(folder / "campaign.json");
  const auto refuses = [&](const std::string& text, const std::string& reason,
                           const AddOptions& options = {}) {
    try {
      Add(folder, Write(text), options);
      ADD_FAILURE() << "took " << text;
    } catch (const base::ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr(reason));
    }
  };
  std::string same = TwoExperiments::FastLift("23 mg");
  same.replace(same.find("fast lift"), 9, "heap");
  refuses(same, "has a test \"heap\" already");
  refuses(R"({"name": "no data"})", "has no data");
  refuses(R"({"name": "gone", "map": "gone.png", "plate_diameter": "10 mm"})", "gone.png");
  refuses(TwoExperiments::FastLift("23 mg"), "--core-time", {.core_time = -1});
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
  EXPECT_EQ(journal.Campaign().spec_json, spec);
  EXPECT_EQ(journal.Campaign().experiments.size(), 1u);
  EXPECT_EQ(base::ReadFile(folder / "campaign.json"), kept);
}

TEST_F(AddExperimentTest, NothingIsAddedToASearchOfOneObjective) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 4}, "workers": 1,
      "confirm": {"candidates": 0}, "strategy": {"kind": "bobyqa"})");
  ASSERT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_THAT(ErrorIn([&] { Add(folder, Write(TwoExperiments::FastLift("23 mg"))); }),
              HasSubstr("its strategy \"bobyqa\" minimises one objective"));
}

// It was to go on by the edited spec, though the test was refused.
TEST_F(AddExperimentTest, WhatCannotBeAddedTakesNoEditedSpecOver) {
  const fs::path folder = Ended();
  const fs::path spec = scratch_.path() / "run_in" / "spec.json";
  std::string text = base::ReadFile(spec);
  text.replace(text.find("\"simulations\": 16"), 17, "\"simulations\": 18");
  std::ofstream(spec) << text;
  const std::string error = ErrorIn([&] {
    Add(folder, Write(R"({"name": "tapped", "rig": {"kind": "tapped_density"},
                          "tapped_density": {"value": 9000, "sd": 10}})"));
  });
  // Found when the test is measured, later than by its keys.
  EXPECT_THAT(ErrorIn([&] {
                Add(folder, Write(R"({"name": "gone", "map": "gone.png",
                                      "plate_diameter": "10 mm"})"));
              }),
              HasSubstr("gone.png"));
  EXPECT_THAT(error, HasSubstr("tapped_density: is 9000"));
  EXPECT_THAT(error, Not(HasSubstr("experiments[1]")));
  const auto progress = journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Progress();
  EXPECT_EQ(progress.state, journal::CampaignState::kFinished);
  EXPECT_EQ(LoadSpec(folder).budget.simulations, 16);
}

}  // namespace add_experiment_test
}  // namespace talus::campaign
