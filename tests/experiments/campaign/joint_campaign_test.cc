// Campaigns over several scale factors, with drawn heaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "base/error.h"
#include "experiments/analysis/compare/gather_evidence.h"
#include "experiments/analysis/export/export.h"
#include "experiments/campaign/answer/alarms.h"
#include "experiments/campaign/answer/answer_summary.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/status.h"
#include "experiments/journal/checksums.h"
#include "experiments/rigs/load_case.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/two_experiments.h"

namespace talus::campaign {
namespace joint_campaign_test {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kTwoSizes = R"(,
  "coarse_graining": {"scale_factors": [2, 1]}, "budget": {"simulations": 16},
  "confirm": {"candidates": 1, "replicates": 2, "ends": false}, "workers": 1)";

using JointCampaign = CampaignFixture;

TEST_F(JointCampaign, TrialsHaveTheScaleFactorsThatTheStrategyAsksForAndConfirmAtTheSmallest) {
  const fs::path folder = Finished(kTwoSizes);
  const auto trials = Trials(folder);
  ASSERT_EQ(trials.size(), 16u + 2u);
  std::set<double> factors;
  for (const journal::TrialRecord& trial : trials) {
    EXPECT_NE(trial.kind, journal::TrialKind::kNoise);
    if (trial.kind == journal::TrialKind::kConfirm) {
      EXPECT_EQ(trial.scale_factor, 1);
    } else {
      factors.insert(trial.scale_factor);
    }
    const rigs::Case rig_case =
        rigs::LoadCase(CampaignFolder{folder}.trial(trial.id) / "case.json");
    EXPECT_EQ(rig_case.coarse_graining.scale_factor, trial.scale_factor);
  }
  EXPECT_EQ(factors, (std::set<double>{1, 2}));
}

TEST_F(JointCampaign, AnInterruptedOneGoesOnAsIfNothingHadHappened) {
  const fs::path whole = Finished(kTwoSizes, {}, "whole");
  const fs::path cut = Finished(kTwoSizes, {}, "cut");
  journal::Database(journal::JournalPath(cut), journal::Database::Mode::kReadWrite)
      .Execute(
          "DELETE FROM profiles WHERE trial > 7; DELETE FROM metrics WHERE trial > 7;"
          "DELETE FROM points WHERE trial > 7; DELETE FROM trials WHERE id > 7");
  EXPECT_EQ(RunFake(cut, {}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(cut), TrialTable(whole));
}

// A later version may recommend another set after the same search. What confirmed the former one
// must not be read as confirming this one.
TEST_F(JointCampaign, ASetIsConfirmedByTrialsOfItsOwn) {
  const fs::path folder = Finished(kTwoSizes);
  {
    journal::Database database(journal::JournalPath(folder), journal::Database::Mode::kReadWrite);
    database.Execute("UPDATE points SET unit_value = 0.5 * unit_value WHERE trial > 16");
    journal::SealAll(database);
  }
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const auto trials = Trials(folder);
  ASSERT_EQ(trials.size(), 16u + 2u + 2u);
  EXPECT_EQ(trials[18].set, trials[17].set + 1);
  EXPECT_EQ(trials[19].set, trials[18].set);
  EXPECT_EQ(Result(folder).confirmed.at(0).experiments.at(0).num_trials, 2);
  RunFake(folder, {});
  EXPECT_EQ(Trials(folder).size(), trials.size());
}

TEST_F(JointCampaign, ItEndsWhenItsCoreTimeIsUsed) {
  const fs::path folder = Begin(R"(, "coarse_graining": {"scale_factors": [2, 1]},
    "budget": {"core_time": "1 us"}, "confirm": {"candidates": 0}, "workers": 1)");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(Trials(folder).size(), 1u);  // a process takes longer than that
  EXPECT_THAT(Result(folder).stop.Text(), HasSubstr("core time is used"));
}

bool SaysThatTheBudgetEndedIt(const Answer& result) {
  return std::ranges::any_of(result.warnings,
                             [](const Alarm& w) { return w.kind == AlarmKind::kBudgetEnded; });
}

TEST_F(JointCampaign, ABudgetThatEndsItTooEarlyIsSaidWithWhatIsMissing) {
  const std::string rule = R"(, "coarse_graining": {"scale_factors": [2, 1]},
    "confirm": {"candidates": 0}, "workers": 1, "posterior": {"stop_share": )";
  const fs::path early = Begin(rule + R"(1e-6}, "budget": {"simulations": 20})", "early");
  RunFake(early, {});
  const Answer cut = Result(early);
  ASSERT_TRUE(cut.unsettled);
  EXPECT_THAT(cut.unsettled->why, HasSubstr("more simulations are expected to narrow the ranges"));
  ASSERT_EQ(cut.unsettled->narrowing.size(), cut.parameters.size());
  EXPECT_EQ(cut.unsettled->narrowing[0].parameter, cut.parameters[0].name);
  EXPECT_EQ(cut.unsettled->num_more, 10);
  EXPECT_TRUE(SaysThatTheBudgetEndedIt(cut));
  EXPECT_THAT(StatusText(early), HasSubstr("the budget of "));
  EXPECT_THAT(StatusText(early),
              HasSubstr("talus resume " + early.string() + " --add-simulations "));
  EXPECT_THAT(base::ReadFile(early / "result.json"), HasSubstr("talus resume DIR"));
  // One that is off is not missed; one that is met is StoppingRule's to test.
  const fs::path off = Begin(rule + R"(0}, "budget": {"simulations": 20})", "off");
  RunFake(off, {});
  EXPECT_FALSE(Result(off).unsettled);
  EXPECT_FALSE(SaysThatTheBudgetEndedIt(Result(off)));
}

TEST_F(JointCampaign, TheResultHoldsThePosteriorAndItsDraws) {
  const fs::path folder = Finished(R"(, "coarse_graining": {"scale_factors": [2, 1]},
    "budget": {"simulations": 30}, "confirm": {"candidates": 1, "replicates": 2}, "workers": 1)");
  const Answer result = Result(folder);
  ASSERT_TRUE(result.posterior.has_value());
  const ResultPosterior& posterior = *result.posterior;
  EXPECT_EQ(posterior.target_scale_factor, 1);
  EXPECT_FALSE(posterior.is_extrapolated);
  EXPECT_GT(posterior.region_volume, 0);
  EXPECT_LT(posterior.region_volume, 0.5);
  ASSERT_FALSE(posterior.branches.empty());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LE(posterior.branches[0].low[i], posterior.branches[0].values[i]);
    EXPECT_GE(posterior.branches[0].high[i], posterior.branches[0].values[i]);
  }
  EXPECT_EQ(posterior.experiments.at(0).name, "heap");
  std::istringstream csv(base::ReadFile(folder / "posterior.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "sliding_friction,rolling_friction");
  std::getline(csv, line);
  const double sliding = std::stod(line);
  EXPECT_GE(sliding, 0.1);  // SI, so within the range and not in the unit cube
  EXPECT_LE(sliding, 0.8);
  EXPECT_THAT(AnswerSummary(result, "runs/heap"), HasSubstr("the joint 90 % region fills"));
}

TEST_F(JointCampaign, ConsiderSaysWhereASetStandsWithoutWritingAnything) {
  for (const char* spec : {kTwoSizes, R"(, "budget": {"simulations": 20}, "workers": 1)"}) {
    const fs::path folder = Finished(spec, {}, spec == kTwoSizes ? "two" : "one");
    const auto at = [&](const char* sliding, const char* rolling) {
      return ConsiderSet(folder, {{"sliding_friction", sliding}, {"rolling_friction", rolling}});
    };
    const auto before = base::ReadFile(journal::JournalPath(folder));
    const ConsideredSet truth = at("0.45", "0.2");
    const ConsideredSet wrong = at("0.75", "0.45");
    EXPECT_EQ(base::ReadFile(journal::JournalPath(folder)), before);
    // The wrong set's heap is twice as high and steep, by some thirty times what seeds change.
    EXPECT_LT(truth.credible_level.value(), wrong.credible_level.value());
    EXPECT_GT(wrong.credible_level.value(), 0.9);
    EXPECT_LT(truth.experiments.at(0).predicted, wrong.experiments.at(0).predicted);
    ASSERT_FALSE(truth.nearest.empty());
    EXPECT_LE(truth.nearest.front().distance, truth.nearest.back().distance);
    EXPECT_THAT(ConsideredText(wrong), HasSubstr("outside the joint 90 % region"));
    EXPECT_THAT(ConsideredJson(wrong), HasSubstr("\"credible_level\""));
  }
}

TEST_F(JointCampaign, ConsiderRefusesWhatIsNoSetOfTheCampaign) {
  const fs::path folder = Begin(kTwoSizes);
  const auto error_of = [&](const std::map<std::string, std::string>& set) {
    return ErrorIn([&] { ConsiderSet(folder, set); });
  };
  const std::string error = error_of({{"sliding_friction", "0.9"}, {"rolling_frction", "0.1"}});
  EXPECT_THAT(error, HasSubstr("sliding_friction: is 0.9, must be in the searched range"));
  EXPECT_THAT(error, HasSubstr("rolling_friction: is missing"));
  EXPECT_THAT(error, HasSubstr("did you mean \"rolling_friction\"?"));
  EXPECT_THAT(error_of({{"sliding_friction", "0.5 m"}, {"rolling_friction", "0.1"}}),
              HasSubstr("sliding_friction: "));
  // Before any trial there is nothing to say, but no error.
  EXPECT_FALSE(ConsiderSet(folder, {{"sliding_friction", "0.5"}, {"rolling_friction", "0.1"}})
                   .credible_level.has_value());
}

TEST_F(JointCampaign, FewGrainsAcrossThePlateAreAWarningOfTheResult) {
  const fs::path folder = Finished(kTwoSizes);  // 10 mm over 0.8 mm
  const Answer result = Result(folder);
  std::vector<Alarm> found;
  std::ranges::copy_if(result.warnings, std::back_inserter(found),
                       [](const Alarm& w) { return w.kind == AlarmKind::kFewGrains; });
  ASSERT_EQ(found.size(), 1u);  // at the finest scale factor; there are 12.5 at the other
  EXPECT_EQ(found[0].scale_factor, 1);
  EXPECT_NEAR(found[0].value.value(), 25, 1e-9);
  EXPECT_THAT(
      AnswerSummary(result, "runs/heap"),
      HasSubstr("only 25 grains across the plate of \"heap\" at their true size: single grains "
                "show in its outline"));
}

TEST_F(TwoExperiments, EachTrialIsOfOneWithItsDeviceAndTheResultSpeaksOfBoth) {
  const fs::path folder = Finished("run");
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
  const auto trials = journal.Trials();
  ASSERT_EQ(trials.size(), 20u + 4u);
  std::array<int, 2> searched{};
  std::array<int, 2> confirmed{};
  for (const journal::TrialRecord& trial : trials) {
    const auto e = static_cast<std::size_t>(trial.experiment);
    ++(trial.kind == journal::TrialKind::kConfirm ? confirmed : searched).at(e);
    const rigs::Case rig_case =
        rigs::LoadCase(CampaignFolder{folder}.trial(trial.id) / "case.json");
    EXPECT_EQ(rig_case.rig.lifted_tube.lift_velocity, trial.experiment == 0 ? 0.01 : 0.2);
    EXPECT_TRUE(trial.Metric("mass_fallen_kg").has_value());
  }
  EXPECT_GT(searched[0], 0);
  EXPECT_GT(searched[1], 0);
  EXPECT_EQ(confirmed, (std::array{2, 2}));
  const journal::CampaignRecord record = journal.Campaign();
  ASSERT_EQ(record.experiments.size(), 2u);
  EXPECT_EQ(record.experiments[1].scalars.at(0).value, 23e-6);

  const Answer result = ParseAnswer(base::ReadFile(folder / "result.json"));
  const auto& experiments = result.confirmed.at(0).experiments;
  ASSERT_EQ(experiments.size(), 2u);
  EXPECT_EQ(experiments[1].name, "fast lift");
  EXPECT_EQ(result.experiments.at(1).numbers.at(0).value, 23e-6);
  EXPECT_EQ(result.posterior.value().experiments.size(), 2u);
  EXPECT_THAT(AnswerSummary(result, "runs/heap"), HasSubstr("mass fallen predicted 2"));
  EXPECT_THAT(StatusText(folder), HasSubstr("fast lift at scale factor 2: "));
  EXPECT_THAT(analysis::TrialsCsv(record, trials), HasSubstr(",fast lift,2,"));
  // Trials are compared with the experiment that they are of.
  const analysis::Evidence fast = analysis::GatherEvidence(folder, "fast lift");
  EXPECT_EQ(fast.trials.size(), static_cast<std::size_t>(searched[1] + confirmed[1]));
  EXPECT_EQ(fast.core_hours, result.cost.core_hours);  // of both tests
  EXPECT_THROW(analysis::GatherEvidence(folder, "slow lift"), base::ConfigError);
}

TEST_F(TwoExperiments, ADamagedJournalIsMadeAnewWithBoth) {
  const fs::path folder = Finished("run");
  const std::string table = TrialTable(folder);
  fs::resize_file(journal::JournalPath(folder), 5000);
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(folder), table);
  EXPECT_EQ(
      journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign().experiments.size(),
      2u);
}

Answer With(const ResultPosterior& posterior) {
  Answer answer;
  answer.posterior = posterior;
  return answer;
}

TEST(PosteriorInWords, AnAlarmWhereNoSetFits) {
  const ResultPosterior posterior{.target_scale_factor = 1,
                                  .is_extrapolated = true,
                                  .unlearnt_scale_factors = {2},
                                  .experiments = {{.name = "heap", .implausibility = 2.9},
                                                  {.name = "wide plate", .implausibility = 3.4}}};
  const auto warnings = PosteriorAlarms(With(posterior));
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_EQ(warnings[0].kind, AlarmKind::kImplausible);
  EXPECT_EQ(warnings[0].experiment, "wide plate");
  EXPECT_THAT(AlarmText(warnings[0]),
              HasSubstr("the contact law, the walls' material or the set-up"));
  EXPECT_EQ(warnings[1].kind, AlarmKind::kExtrapolated);
  EXPECT_EQ(warnings[2].kind, AlarmKind::kUnlearntScaleFactor);
  EXPECT_EQ(warnings[2].scale_factor, 2);
}

TEST(PosteriorInWords, FewSimulationsOfSeveralExperimentsAreSaid) {
  ResultPosterior posterior{
      .target_scale_factor = 1,
      .fewest_at_finest = 8,
      .experiments = {{.name = "heap", .caution = 1.3}, {.name = "wide plate", .caution = 1.8}}};
  const auto warnings = PosteriorAlarms(With(posterior));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, AlarmKind::kFewSimulations);
  EXPECT_THAT(AlarmText(warnings[0]), HasSubstr("\"wide plate\" has only 8 simulations"));
  // A search that ended since more would hardly narrow the ranges has counted that in.
  Answer done = With(posterior);
  done.stop = {.kind = StopKind::kRule,
               .rule = optimizer::StopReason{.rule = optimizer::StopRule::kShare}};
  EXPECT_TRUE(PosteriorAlarms(done).empty());
  posterior.fewest_at_finest = 12;
  EXPECT_TRUE(PosteriorAlarms(With(posterior)).empty());
  posterior.fewest_at_finest = 8;
  posterior.experiments.pop_back();  // one alone has room enough
  EXPECT_TRUE(PosteriorAlarms(With(posterior)).empty());
}

}  // namespace joint_campaign_test
}  // namespace talus::campaign
