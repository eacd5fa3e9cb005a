#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/analysis/export/export.h"
#include "experiments/campaign/answer/answer_summary.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/status.h"
#include "experiments/journal/database.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::campaign {
namespace campaign_test {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr const char* kSmall = R"(,
  "strategy": {"kind": "sobol"}, "budget": {"simulations": 12}, "noise": {"replicates": 2},
  "confirm": {"candidates": 2, "replicates": 2}, "workers": 1)";

using CampaignTest = CampaignFixture;

std::string ErrorOf(const auto& action) { return ErrorIn<base::Error>(action); }

TEST_F(CampaignTest, NoiseFirstThenTheSearchThenTheConfirmation) {
  const fs::path folder = Begin(kSmall);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const auto trials = Trials(folder);
  ASSERT_EQ(trials.size(), 12u + 2u);  // one branch, so one candidate
  EXPECT_EQ(trials[0].kind, journal::TrialKind::kNoise);
  EXPECT_EQ(trials[1].kind, journal::TrialKind::kNoise);
  EXPECT_EQ(trials[0].unit, trials[1].unit);
  EXPECT_NE(trials[0].seed, trials[1].seed);
  EXPECT_EQ(trials[2].kind, journal::TrialKind::kDesign);
  EXPECT_EQ(trials[12].kind, journal::TrialKind::kConfirm);
  EXPECT_EQ(trials[12].unit, trials[13].unit);
  for (const journal::TrialRecord& trial : trials) {
    EXPECT_EQ(trial.status, journal::TrialStatus::kOk);
    EXPECT_TRUE(trial.Metric("sad_mm2").has_value());
    EXPECT_TRUE(trial.Metric("rmse_gray").has_value());
    EXPECT_TRUE(fs::exists(
        folder / "trials" /
        ("00" + std::string(trial.id < 10 ? "0" : "") + std::to_string(trial.id)) / "case.json"));
  }
}

TEST_F(CampaignTest, TheResultSaysWhatIsRecommendedHowSureAndUnderWhichConditions) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 20}, "workers": 1)");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const Answer result = Result(folder);
  ASSERT_EQ(result.parameters.size(), 2u);
  // One drawn heap scatters by 0.01 in μ_r and by 0.3/20 in μ_t, and so does the experiment, which
  // is one such heap; three times the two together. The ranges are ten times as wide.
  EXPECT_NEAR(result.parameters[0].value, kTrueSliding, 0.06);
  EXPECT_NEAR(result.parameters[1].value, kTrueRolling, 0.06);
  EXPECT_LE(result.parameters[1].credible_low, result.parameters[1].value);
  EXPECT_GE(result.parameters[1].credible_high, result.parameters[1].value);
  ASSERT_EQ(result.experiments.size(), 1u);
  EXPECT_GT(result.experiments[0].noise_sd.value_or(0), 0);
  ASSERT_TRUE(result.posterior.has_value());
  EXPECT_LT(result.posterior->region_volume, 0.5);
  EXPECT_TRUE(result.verdict.has_value());
  ASSERT_FALSE(result.confirmed.empty());
  const ResultConfirmed& confirmed = result.confirmed[0].experiments.at(0);
  EXPECT_GT(confirmed.num_trials, 0);
  EXPECT_GT(confirmed.mean, 0);
  // Averaging over seeds takes scatter away, so the mean profile is nearer than a single one.
  EXPECT_LT(confirmed.profile_sad_mm2.value(), confirmed.sad_mm2.value());
  EXPECT_FALSE(result.experiments[0].noise_floor.has_value());  // a map has no runs
  ASSERT_EQ(result.conditions.devices.size(), 1u);
  EXPECT_THAT(result.conditions.devices[0].text, HasSubstr("lifted tube: "));
  EXPECT_EQ(result.conditions.scale_factor, 1);
  EXPECT_EQ(result.stop.kind, StopKind::kSimulations);
  const std::string summary = AnswerSummary(result, "runs/heap");
  // What ended it is said once.
  const std::size_t first = summary.find("simulations is used");
  ASSERT_NE(first, std::string::npos) << summary;
  EXPECT_EQ(summary.find("simulations is used", first + 1), std::string::npos);
  EXPECT_THAT(summary, HasSubstr("lift velocity 1 cm/s"));
}

// Whoever chooses the trials, the posterior answers: the recommended set, asked for by its printed
// values, stands in `talus consider` as in the result.
TEST_F(CampaignTest, ConsideringTheRecommendedSetAgreesWithTheResultToTheDigit) {
  for (const char* kind : {"auto", "sobol", "lhs", "gp"}) {
    const fs::path folder =
        Begin(R"(, "budget": {"simulations": 14}, "workers": 1, "strategy": {"kind": ")" +
                  std::string(kind) + "\"}",
              kind);
    ASSERT_EQ(RunFake(folder, {}), CampaignEnd::kFinished) << kind;
    const Answer result = Result(folder);
    ASSERT_TRUE(result.posterior && result.verdict) << kind;
    std::map<std::string, std::string> set;
    for (const ResultParameter& p : result.parameters) {
      set[p.name] = base::JsonText(nlohmann::json(p.value)) + (p.unit.empty() ? "" : " " + p.unit);
    }
    const ConsideredSet considered = ConsiderSet(folder, set);
    ASSERT_EQ(considered.experiments.size(), 1u) << kind;
    const ResultStanding& standing = considered.experiments[0];
    const ResultStanding& stated = result.posterior->experiments.at(0);
    // Twelve digits: the value as text moves its place in the unit cube by one in the last. An
    // implausibility near 0 is the difference of two such numbers.
    for (const auto& [one, other] : {std::pair{standing.predicted, stated.predicted},
                                     {standing.predicted_sd, stated.predicted_sd},
                                     {standing.implausibility, stated.implausibility}}) {
      EXPECT_NEAR(one, other, 1e-12 * std::max(1.0, std::abs(other))) << kind;
    }
    EXPECT_LE(considered.credible_level.value(), 0.9) << kind;
  }
}

TEST_F(CampaignTest, TrialsEndedFromOutsideAreRunAgainAsTheyWere) {
  const fs::path calm = Finished(kSmall, {}, "calm");
  const fs::path disturbed = Begin(kSmall, "disturbed");
  EXPECT_EQ(RunFake(disturbed, {.die_once = true}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(disturbed), TrialTable(calm));
  EXPECT_THAT(base::ReadFile(disturbed / "campaign.log"), HasSubstr("it is run again"));
}

TEST_F(CampaignTest, FailuresAreRecordedAndTheSearchGoesOn) {
  const fs::path folder = Begin(kSmall);
  EXPECT_EQ(RunFake(folder, {.fail_at_low = true}), CampaignEnd::kFinished);
  int failed = 0;
  for (const journal::TrialRecord& trial : Trials(folder)) {
    EXPECT_EQ(trial.status == journal::TrialStatus::kFailed, trial.native[0] < 0.3)
        << trial.native[0];
    if (trial.status != journal::TrialStatus::kFailed) continue;
    ++failed;
    EXPECT_EQ(trial.reason, "exit status 3: no heap");
    EXPECT_EQ(trial.attempts, 1);
  }
  EXPECT_GT(failed, 0);
  EXPECT_THAT(StatusText(folder), HasSubstr("× exit status 3: no heap"));
}

TEST_F(CampaignTest, AFailedTrialIsTriedOnceMoreWithAnotherSeedIfTheSpecSaysSo) {
  const fs::path folder = Begin(std::string(kSmall) + R"(, "retry_failed": true)");
  EXPECT_EQ(RunFake(folder, {.fail_once = true}), CampaignEnd::kFinished);
  const fs::path other = Finished(kSmall, {}, "other");
  const auto retried = Trials(folder);
  const auto calm = Trials(other);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(retried[i].status, journal::TrialStatus::kOk);
    EXPECT_EQ(retried[i].attempts, 2);
    EXPECT_NE(retried[i].seed, calm[i].seed);
  }
}

TEST_F(CampaignTest, WhereEveryTrialFailsItEndsEarlyWithTheReason) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 50}, "workers": 1,
    "strategy": {"kind": "sobol"})");
  const std::string marker = (folder / "trials").string();
  EXPECT_EQ(RunFake(folder, {.fail_once = true}), CampaignEnd::kFailed);
  EXPECT_EQ(Trials(folder).size(), 8u);
  const std::string status = StatusText(folder);
  EXPECT_THAT(status, HasSubstr("the first 8 trials all failed, the last: "));
  EXPECT_THAT(status, HasSubstr("ended without a result; mend the cause, and `talus resume"));
  EXPECT_THAT(status, testing::Not(HasSubstr("time left")));
}

// A reason that quotes a seed was a line for each trial, and its line breaks began lines of
// nothing.
TEST_F(CampaignTest, ReasonsThatDifferInNumbersAreOneLineOfTheStatus) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 50}, "workers": 1,
    "strategy": {"kind": "sobol"})");
  EXPECT_EQ(RunFake(folder, {.seed_in_reason = true}), CampaignEnd::kFailed);
  const std::string status = StatusText(folder);
  EXPECT_THAT(status, HasSubstr("    8 × exit status 4: seed "));
  EXPECT_THAT(status, HasSubstr("\n        lost atoms (the numbers differ)\n"));
}

// The set-up has been mended since: else the campaign could never go on, or its search would keep
// away from sets that nothing was wrong with.
TEST_F(CampaignTest, WhereEveryTrialHasFailedResumingRunsThemAgain) {
  const fs::path folder = Begin(kSmall);
  EXPECT_EQ(RunFake(folder, {.fail_once = true}), CampaignEnd::kFailed);
  const auto failed = Trials(folder);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const fs::path other = Finished(kSmall, {}, "other");
  const auto mended = Trials(folder), calm = Trials(other);
  ASSERT_EQ(mended.size(), calm.size());
  ASSERT_GE(failed.size(), 8u);
  for (std::size_t i = 0; i < calm.size(); ++i) {
    EXPECT_EQ(mended[i].status, journal::TrialStatus::kOk) << i;
    EXPECT_EQ(mended[i].seed, calm[i].seed) << i;
    EXPECT_EQ(mended[i].unit, calm[i].unit) << i;
    EXPECT_EQ(mended[i].finish_order, calm[i].finish_order) << i;
  }
}

TEST_F(CampaignTest, AnExtendedCampaignHasTheTrialsOfALongerOne) {
  const fs::path folder = Finished(kSmall);
  EXPECT_EQ(RunFake(folder, {}, {.spec = {}, .add_simulations = 5, .objective = {}}),
            CampaignEnd::kFinished);
  std::string longer = kSmall;
  longer.replace(longer.find("\"simulations\": 12"), 17, "\"simulations\": 17");
  const fs::path other = Begin(longer, "longer");
  RunFake(other, {});
  const auto search = [](const std::vector<journal::TrialRecord>& trials) {
    std::vector<std::pair<std::vector<double>, std::int64_t>> list;
    for (const journal::TrialRecord& t : trials) {
      if (t.kind != journal::TrialKind::kConfirm) list.emplace_back(t.unit, t.seed);
    }
    return list;
  };
  EXPECT_EQ(search(Trials(folder)), search(Trials(other)));
  EXPECT_EQ(search(Trials(folder)).size(), 17u);
}

TEST_F(CampaignTest, TheStatusSpeaksOfOneTrial) {
  const fs::path folder = Begin(R"(, "strategy": {"kind": "sobol"}, "workers": 1,
    "budget": {"simulations": 1}, "noise": {"replicates": 0}, "confirm": {"candidates": 0})");
  RunFake(folder, {});
  EXPECT_THAT(StatusText(folder), HasSubstr(": 1 trial besides those that confirm; "));
  EXPECT_THAT(StatusText(folder), HasSubstr("1 of 1 simulation\n"));
}

// It named the best trial by SAD beside an answer in degrees.
TEST_F(CampaignTest, TheStatusIsByTheObjectiveOfTheResult) {
  const fs::path folder = Finished(kSmall);
  EXPECT_THAT(StatusText(folder), HasSubstr(" mm², trial "));
  RunFake(folder, {}, {.spec = {}, .add_simulations = 2, .objective = journal::Objective::kAor2});
  EXPECT_THAT(StatusText(folder), HasSubstr(" ° off, trial "));
  EXPECT_THAT(StatusText(folder), Not(HasSubstr(" mm², trial ")));
}

TEST_F(CampaignTest, AChangedSpecIsRefusedWithWhatChangedUnlessItMayChange) {
  const fs::path folder = Begin(kSmall);
  RunFake(folder, {});
  const fs::path spec = scratch_.path() / "run_in" / "spec.json";
  std::string text = base::ReadFile(spec);
  std::string other = text;
  other.replace(other.find("0.5 g"), 5, "0.6 g");
  std::ofstream(spec) << other;
  const std::string error = ErrorOf([&] { RunFake(folder, {}); });
  EXPECT_THAT(error, HasSubstr("powder.mass: 0.0005 → 0.0006"));

  text.replace(text.find("\"simulations\": 12"), 17, "\"simulations\": 14");
  std::ofstream(spec) << text;
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  int search = 0;
  for (const journal::TrialRecord& t : Trials(folder))
    search += t.kind != journal::TrialKind::kConfirm;
  EXPECT_EQ(search, 14);
}

// The budget was raised before the rest was looked at, and a large one turned negative.
TEST_F(CampaignTest, ARefusedExtensionChangesNothing) {
  const fs::path folder = Begin(kSmall);
  RunFake(folder, {});
  const std::string before =
      journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_json;
  const auto extend = [&](int more) {
    return ErrorOf([&] { RunFake(folder, {}, {.spec = {}, .add_simulations = more}); });
  };
  EXPECT_THAT(extend(2147483647), HasSubstr("--add-simulations: 2147483647 more would be above"));
  const fs::path spec = scratch_.path() / "run_in" / "spec.json";
  std::string text = base::ReadFile(spec);
  text.replace(text.find("0.5 g"), 5, "0.6 g");
  std::ofstream(spec) << text;
  EXPECT_THAT(extend(5), HasSubstr("powder.mass"));
  EXPECT_EQ(journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_json,
            before);
}

TEST_F(CampaignTest, ADamagedSpecInTheJournalIsRepaired) {
  const fs::path folder = Begin(kSmall);
  const std::string before =
      journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_json;
  {
    journal::Database database(journal::JournalPath(folder), journal::Database::Mode::kReadWrite);
    database.Execute("UPDATE campaign SET spec_json = replace(spec_json, '12', '13')");
  }
  EXPECT_THAT(ErrorOf([&] { journal::Journal::OpenReadOnly(journal::JournalPath(folder)); }),
              HasSubstr("`talus resume` repairs it"));
  RunFake(folder, {});
  EXPECT_EQ(journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().spec_json,
            before);
}

TEST_F(CampaignTest, FilesOfOthersAreNotOverwritten) {
  const fs::path folder = scratch_.path() / "mine";
  fs::create_directories(folder / "trials" / "0001");
  std::ofstream(folder / "trials" / "0001" / "thesis.txt") << "years of work";
  EXPECT_THAT(ErrorOf([&] { Begin(kSmall, "mine"); }), HasSubstr("holds other files"));
  EXPECT_EQ(std::distance(fs::recursive_directory_iterator(folder), {}), 3);
  // A campaign that has lost its journal is one.
  const fs::path other = Finished(kSmall, {}, "other");
  const std::string result = base::ReadFile(other / "result.json");
  fs::remove(journal::JournalPath(other));
  EXPECT_THAT(ErrorOf([&] { Begin(kSmall, "other"); }), HasSubstr("holds a campaign already"));
  EXPECT_EQ(base::ReadFile(other / "result.json"), result);
}

// As when a network file system goes away, or sbatch refuses a partition: no trial's fault.
TEST_F(CampaignTest, TrialsThatCannotBeStartedStopTheCampaign) {
  const fs::path folder = Begin(kSmall);
  const std::string error = ErrorOf([&] { RunFake(folder, {.no_command = true}); });
  EXPECT_THAT(error, HasSubstr("could not be started"));
  EXPECT_THAT(error, HasSubstr("`talus resume` goes on with the same trial"));
  for (const journal::TrialRecord& trial : Trials(folder))
    EXPECT_EQ(trial.status, journal::TrialStatus::kRunning);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  for (const journal::TrialRecord& trial : Trials(folder))
    EXPECT_EQ(trial.status, journal::TrialStatus::kOk);
}

TEST_F(CampaignTest, ASecondProcessIsRefused) {
  const fs::path folder = Begin(kSmall);
  const CampaignLock lock(folder);
  EXPECT_THAT(ErrorOf([&] { RunFake(folder, {}); }), HasSubstr("another process"));
  EXPECT_TRUE(IsWorkedOn(folder));
}

TEST_F(CampaignTest, NothingIsBegunTwiceOrWithAnExperimentThatCannotBeUsed) {
  Begin(kSmall);
  EXPECT_THAT(ErrorOf([&] { Begin(kSmall); }), HasSubstr("talus resume"));
  const fs::path spec = WriteFakeSpec(scratch_.path() / "bad", kSmall);
  std::ofstream(scratch_.path() / "bad" / "map.png") << "no image";
  EXPECT_THAT(ErrorOf([&] { BeginCampaign(spec, scratch_.path() / "bad_run"); }),
              HasSubstr("map.png"));
  EXPECT_FALSE(fs::exists(scratch_.path() / "bad_run"));
}

TEST_F(CampaignTest, ExportsOneLineATrialWithUnitsInTheHead) {
  const fs::path folder = Finished(kSmall);
  analysis::ExportCampaign(folder, folder / "export");
  const std::string csv = base::ReadFile(folder / "export" / "trials.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 15);
  EXPECT_THAT(csv, HasSubstr("scale_factor,sliding_friction,rolling_friction,"));
  EXPECT_THAT(csv, HasSubstr(",sad_mm2,"));
  EXPECT_NO_THROW(base::ParseJson(base::ReadFile(folder / "export" / "trials.json"), "json"));
}

TEST_F(CampaignTest, SeveralWorkersAndReplicatesMakeEveryTrialOnce) {
  const fs::path folder = Begin(R"(, "strategy": {"kind": "sobol"}, "replicates": 2,
    "budget": {"simulations": 12}, "noise": {"replicates": 2}, "workers": 4)");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  std::map<std::int64_t, int> sets;
  std::set<std::int64_t> seeds;
  for (const journal::TrialRecord& t : Trials(folder)) {
    seeds.insert(t.seed);
    if (t.kind == journal::TrialKind::kDesign || t.kind == journal::TrialKind::kSearch)
      ++sets[t.set];
  }
  EXPECT_EQ(seeds.size(), Trials(folder).size());
  EXPECT_EQ(sets.size(), 5u);
  for (const auto& [set, count] : sets) EXPECT_EQ(count, 2);
}

// The strategy is told of trials as they were expected to end, not as they end.
TEST_F(CampaignTest, WithSeveralWorkersTheTrialsDoNotHangOnWhichEndsFirst) {
  constexpr const char* kThree = R"(, "budget": {"simulations": 20}, "workers": 3,
    "coarse_graining": {"scale_factors": [2, 1]})";
  const fs::path calm = Begin(kThree, "calm");
  EXPECT_EQ(RunFake(calm, {}), CampaignEnd::kFinished);
  const std::string table = TrialTable(calm);
  EXPECT_THAT(table, HasSubstr("model"));  // what is proposed follows from what was told
  for (const int third : {1, 2}) {
    const fs::path uneven = Begin(kThree, "uneven" + std::to_string(third));
    EXPECT_EQ(RunFake(uneven, {.die_once = third == 2, .slow_third = third}),
              CampaignEnd::kFinished);
    EXPECT_EQ(TrialTable(uneven), table) << third;
  }
}

// What was told after a rule had ended the search is no reason to go on with it.
TEST_F(CampaignTest, ASearchThatARuleHasEndedIsNotResumedUnlessMoreIsAskedFor) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 20}, "workers": 1)");
  const Stop stop{.kind = StopKind::kRule, .rule = optimizer::StopReason{.name = "the rule"}};
  journal::Journal::Open(journal::JournalPath(folder))
      .SetProgress({.state = journal::CampaignState::kInterrupted,
                    .stop_json = base::JsonTextWriter::TextOf(stop)});
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFailed);  // without a trial there is no answer
  EXPECT_EQ(Trials(folder).size(), 0u);
  EXPECT_EQ(journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Progress().stop_reason,
            stop.Text());
  RunFake(folder, {}, {.add_simulations = 5});
  EXPECT_GE(Trials(folder).size(), 5u);
}

TEST_F(CampaignTest, ReplicatesOfManyAtOnceKeepToTheBudget) {
  const auto folder = Begin(R"(, "budget": {"simulations": 6}, "replicates": 2, "workers": 8,
    "confirm": {"candidates": 0})");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(Trials(folder).size(), 6u);
}

TEST_F(CampaignTest, NothingIsConfirmedBeforeTheLastTrialOfTheSearchIsTold) {
  const auto folder = Begin(R"(, "budget": {"simulations": 8}, "workers": 3,
    "confirm": {"candidates": 1, "ends": false, "replicates": 2})");
  EXPECT_EQ(RunFake(folder, {.slow_third = 2}), CampaignEnd::kFinished);
  const Answer answer = Result(folder);
  int confirming = 0;
  for (const journal::TrialRecord& trial : Trials(folder)) {
    if (trial.IsOfSearch()) continue;
    ++confirming;
    EXPECT_TRUE(IsRecommended(answer, trial.native)) << trial.id;
  }
  EXPECT_EQ(confirming, 2);
}

TEST_F(CampaignTest, AFailedTrialIsNotTriedAThirdTime) {
  const auto folder = Begin(R"(, "budget": {"simulations": 8}, "noise": {"replicates": 2},
    "workers": 1, "confirm": {"candidates": 1, "replicates": 3}, "retry_failed": true)");
  RunFake(folder, {.fail_at_low = true});
  int failed = 0;
  for (const journal::TrialRecord& trial : Trials(folder)) {
    if (trial.status != journal::TrialStatus::kFailed) continue;
    ++failed;
    EXPECT_EQ(trial.attempts, 2);
  }
  EXPECT_GT(failed, 0);
}

// They tell how well the answer is met, which what found it may not know.
TEST_F(CampaignTest, ConfirmingTrialsAreNotToldToTheModel) {
  const auto folder = Finished(R"(, "budget": {"simulations": 8}, "noise": {"replicates": 2},
    "workers": 1, "confirm": {"candidates": 1, "replicates": 3})");
  const auto trials = Trials(folder);
  const auto searched = std::ranges::count_if(trials, &journal::TrialRecord::IsOfSearch);
  ASSERT_LT(searched, std::ssize(trials));
  EXPECT_EQ(std::ssize(ReadJointView(folder).observations), searched);
}

}  // namespace campaign_test
}  // namespace talus::campaign
