#include "experiments/campaign/answer/alarms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "experiments/campaign/answer/fit.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/journal/journal.h"
#include "imaging/photos/photo_warning.h"
#include "tests/experiments/campaign/confirmed_answer.h"

namespace talus::campaign {
namespace alarms_test {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Reference EmptyReference() {
  imaging::Profile aehp{.image = {.width = 8, .height = 8, .pixels = {}},
                        .frame = {.width = 8,
                                  .height = 8,
                                  .pixel_size = 1e-3,
                                  .center_x = 4,
                                  .baseline = 7,
                                  .plate_diameter = 6e-3}};
  aehp.image.pixels.assign(64, 255);
  for (int x = 2; x < 6; ++x) aehp.image.at(x, 6) = 0;
  return {std::move(aehp), {}};
}

journal::TrialRecord TrialWith(std::int64_t id, double sad_mm2, double scale_factor = 1) {
  journal::TrialRecord trial;
  trial.id = id;
  trial.scale_factor = scale_factor;
  trial.status = journal::TrialStatus::kOk;
  trial.metrics = {{.name = "sad_mm2", .value = sad_mm2, .unit = "mm2", .undefined = {}}};
  return trial;
}

TEST(Alarms, ConfirmedWorseThanPredictedIsSaid) {
  // Twice √(0.2² + 0.1²) is 0.45.
  EXPECT_THAT(PredictionAlarms(ConfirmedAt(4.3)), IsEmpty());
  const auto alarms = PredictionAlarms(ConfirmedAt(7.99));
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].kind, AlarmKind::kWorseThanPredicted);
  EXPECT_NEAR(*alarms[0].value, 3.99, 1e-9);
  EXPECT_THAT(AlarmText(alarms[0]),
              HasSubstr("misses \"heap\" by 8, 4 more than the model predicted"));
}

// The mean profile's mm² and the noise floor say nothing of an angle.
TEST(Alarms, AnAngleIsNotHeldAgainstAnArea) {
  Answer answer = ConfirmedAt(7.99);
  answer.objective = "aor2_difference_deg";
  answer.confirmed[0].experiments[0].num_trials = 3;
  answer.confirmed[0].experiments[0].profile_sad_mm2 = 0.6;
  answer.experiments[0].noise_floor = 100;
  const auto alarms = PredictionAlarms(answer);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_NEAR(*alarms[0].shown, 7.99, 1e-9);
  EXPECT_FALSE(alarms[0].noise_floor.has_value());
}

// Runs of the experiment differ by 3: what is 0.6 above the prediction is lost in that.
TEST(Alarms, AnExcessFarBelowTheNoiseFloorIsNoAlarm) {
  Answer answer = ConfirmedAt(4.6);
  EXPECT_THAT(PredictionAlarms(answer), SizeIs(1));
  answer.experiments[0].noise_floor = 3;
  EXPECT_THAT(PredictionAlarms(answer), IsEmpty());
}

// A prediction of the mean heap is held against the mean profile, not against runs that scatter.
TEST(Alarms, MeanProfileAsPredictedIsNoAlarm) {
  Answer answer = ConfirmedAt(5.5);
  HeapOf(answer).profile_sad_mm2 = 4.1;
  EXPECT_THAT(PredictionAlarms(answer), IsEmpty());
}

// Mean profiles of three heaps scatter, too: √(4.2² + 3.5²) = 5.47 for one heap, √(4.2² + 3.5²/3) =
// 4.66 for three, 0.66 above the prediction, of which 0.2 are the set's.
TEST(Alarms, ScatterOfTheMeanProfileIsNoAlarm) {
  Answer answer = ConfirmedAt(5.47);
  HeapOf(answer).profile_sad_mm2 = 4.66;
  EXPECT_THAT(PredictionAlarms(answer), IsEmpty());
}

// Single silhouettes are far from a mean image by RMSE, whatever the set: that of the mean heap is
// what was predicted. Every perfect set was called worse than predicted.
TEST(Alarms, OfAnotherObjectiveTheMeanHeapsIsComparedToo) {
  Answer answer = ConfirmedAt(12.8);
  answer.objective = "rmse";
  EXPECT_THAT(PredictionAlarms(answer), SizeIs(1));
  HeapOf(answer).profile_objective = 4.1;
  EXPECT_THAT(PredictionAlarms(answer), IsEmpty());
  EXPECT_EQ(ComparableOf(answer, HeapOf(answer)), 4.1);
}

// All fresh seeds of the recommended set have failed, those of an end have not: what the end gives
// is not the answer's.
TEST(Alarms, WhatAnotherSetGivesConfirmsNothing) {
  Answer answer = ConfirmedAt(9);
  answer.confirmed[0].role = CandidateRole::kEnd;
  EXPECT_EQ(ConfirmedSet(answer), nullptr);
  EXPECT_EQ(ConfirmedOf(answer, "heap"), nullptr);
  EXPECT_EQ(ConfirmedAtTarget(answer, "heap"), nullptr);
  EXPECT_THAT(PredictionAlarms(answer), IsEmpty());
}

// The best of 40 that are as good as the recommended set lies that far below it once in fifty
// times; the best of one would not.
TEST(Alarms, TheBestOfManyTrialsOwesMoreToLuck) {
  const Answer answer = ConfirmedAt(4.2);
  const std::vector<Reference> one{EmptyReference()};
  std::vector<journal::TrialRecord> trials{TrialWith(1, 3.2)};  // 2.8 of √(0.2² + 0.3²)
  EXPECT_THAT(SearchAlarms(answer, trials, one), SizeIs(1));
  for (int id = 2; id <= 40; ++id) trials.push_back(TrialWith(id, 4.2));
  EXPECT_THAT(SearchAlarms(answer, trials, one), IsEmpty());
}

TEST(Alarms, ATrialThatCameOutBetterIsNamed) {
  const Answer answer = ConfirmedAt(4.2);
  const std::vector<Reference> one{EmptyReference()};
  // Twice √(0.2² + 0.3²) is 0.72: 3.6 may be luck, 3.0 is not. Coarse grains make another heap.
  EXPECT_THAT(SearchAlarms(answer, {TrialWith(1, 3.6)}, one), IsEmpty());
  EXPECT_THAT(SearchAlarms(answer, {TrialWith(1, 1.0, 2)}, one), IsEmpty());
  const std::vector<journal::TrialRecord> trials{TrialWith(1, 3.6), TrialWith(7, 3.0)};
  const auto alarms = SearchAlarms(answer, trials, one);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].kind, AlarmKind::kWorseThanObserved);
  EXPECT_EQ(alarms[0].trial, 7);
  EXPECT_THAT(AlarmText(alarms[0]), HasSubstr("trial 7 came out better"));
  // With several experiments a trial may meet one better than the set that meets them all.
  EXPECT_THAT(SearchAlarms(answer, trials, {EmptyReference(), EmptyReference()}), IsEmpty());
}

TEST(Alarms, SimulationsThatAreAllAlikeAreNamed) {
  const auto trials = [](int count, double last) {
    std::vector<journal::TrialRecord> all(static_cast<std::size_t>(count));
    for (journal::TrialRecord& trial : all) {
      trial.status = journal::TrialStatus::kOk;
      trial.metrics = {{.name = "a", .value = 28, .unit = "deg", .undefined = ""},
                       {.name = "b", .value = NAN, .unit = "deg", .undefined = "empty"}};
    }
    all.back().metrics[0].value = last;
    return all;
  };
  const std::vector<ResultExperiment> heap{{.name = "heap"}};
  EXPECT_THAT(AlikeAlarms(trials(5, 28), heap), IsEmpty());
  EXPECT_THAT(AlikeAlarms(trials(8, 28.000001), heap), IsEmpty());
  const auto alarms = AlikeAlarms(trials(8, 28), heap);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_THAT(AlarmText(alarms[0]), HasSubstr("all 8 simulations of \"heap\" gave exactly"));
}

TEST(Alarms, UnconfirmedPredictionIsHeldAgainstTheTrials) {
  Answer answer = ConfirmedAt(0);
  answer.confirmed.clear();
  EXPECT_THAT(SearchAlarms(answer, {TrialWith(3, 2.0)}, {EmptyReference()}), SizeIs(1));
}

TEST(Alarms, ModelThatPredictsBadlyIsSaid) {
  Answer answer;
  EXPECT_THAT(PosteriorAlarms(answer), IsEmpty());  // not known
  answer.posterior.emplace();
  answer.posterior->num_left_out = 40;
  answer.posterior->raw_coverage = 0.88;
  EXPECT_THAT(PosteriorAlarms(answer), IsEmpty());
  answer.posterior->raw_coverage = 0.5;
  const auto alarms = PosteriorAlarms(answer);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].kind, AlarmKind::kPoorModel);
  EXPECT_THAT(AlarmText(alarms[0]), HasSubstr("50 % lay within its 90 % regions"));
}

TEST(Alarms, AParameterOnTheEndOfItsRangeIsSaid) {
  EXPECT_THAT(BoundAlarms(ResultWithSet(0.5, 1e-5)), IsEmpty());
  EXPECT_THAT(BoundAlarms(ResultWithSet(0.01, 1.1e-6)), IsEmpty());
  const auto alarms = BoundAlarms(ResultWithSet(0.998, 1.01e-6));
  ASSERT_THAT(alarms, SizeIs(2));
  EXPECT_EQ(alarms[0].kind, AlarmKind::kBound);
  EXPECT_EQ(alarms[0].parameter, "sliding_friction");
  EXPECT_EQ(alarms[0].side, "upper");
  EXPECT_EQ(AlarmText(alarms[0]), "sliding_friction lies on its upper bound: widen its range");
  EXPECT_EQ(alarms[1].parameter, "surface_energy");
  EXPECT_EQ(alarms[1].side, "lower");
}

TEST(Alarms, ParametersKnownTogetherOnlyAreSaidUnlessTheAnswerIsAPoint) {
  Answer result = ResultWithSet(0.5, 1e-5);
  result.correlation = {{1, -0.93}, {-0.93, 1}};
  EXPECT_THAT(CorrelationAlarms(result), IsEmpty());  // no ranges, so no verdict
  for (const VerdictKind kind : {VerdictKind::kPoint, VerdictKind::kRegion}) {
    result.verdict = ResultVerdict{.kind = kind, .text = {}};
    EXPECT_THAT(CorrelationAlarms(result), IsEmpty());
  }
  for (const VerdictKind kind : {VerdictKind::kCurve, VerdictKind::kSeparate}) {
    result.verdict = ResultVerdict{.kind = kind, .text = {}};
    const auto alarms = CorrelationAlarms(result);
    ASSERT_THAT(alarms, SizeIs(1));
    EXPECT_EQ(alarms[0].kind, AlarmKind::kCorrelated);
    EXPECT_EQ(alarms[0].value, -0.93);
    EXPECT_THAT(AlarmText(alarms[0]),
                HasSubstr("sliding_friction and surface_energy are known together"
                          " only (correlation -0.93)"));
  }
  result.correlation = {{1, -0.7}, {-0.7, 1}};
  EXPECT_THAT(CorrelationAlarms(result), IsEmpty());
}

// Those of photographs come with words; each other kind has its own.
TEST(Alarms, EveryKindHasWordsOfItsOwn) {
  std::set<std::string> texts;
  int of_results = 0;
  for (const auto& [name, kind] : base::Names<AlarmKind>::kList) {
    if (kind == AlarmKind::kMoreThanFilled) break;
    ++of_results;
    texts.insert(AlarmText({.kind = kind}));
  }
  EXPECT_EQ(of_results, 18);
  EXPECT_THAT(texts, SizeIs(18));
  EXPECT_FALSE(texts.contains(""));
}

TEST(Alarms, CommandsNameTheFolderWhereTheyAreShown) {
  EXPECT_EQ(WithFolder("try `talus resume DIR --add-simulations 20` or `talus next DIR`", "runs/a"),
            "try `talus resume runs/a --add-simulations 20` or `talus next runs/a`");
  EXPECT_EQ(WithFolder("talus card DIR", "my runs/it's $a"), "talus card 'my runs/it'\\''s $a'");
  EXPECT_EQ(WithFolder("in DIR, talus report DIRECTORY", "a"), "in DIR, talus report DIRECTORY");
}

// Summary, verdict and result.json said nothing of a goal that the budget had ended.
TEST(Alarms, AGoalThatIsMissedIsSaid) {
  CampaignSpec spec;
  EXPECT_THAT(GoalAlarms(spec, {}), IsEmpty());
  spec.goal = {.file = "/x/spread.json", .observable = "packing_fraction", .half_width = 0.01};
  GoalState state{.after = 24, .half_width = 0.03};
  const auto missed = GoalAlarms(spec, state);
  ASSERT_THAT(missed, SizeIs(1));
  EXPECT_EQ(missed[0].kind, AlarmKind::kGoalMissed);
  EXPECT_THAT(AlarmText(missed[0]), HasSubstr("known to ± 0.03 (90 %) after 24 trials"));
  EXPECT_THAT(AlarmText(GoalAlarms(spec, {}).at(0)), HasSubstr("was never looked at"));
  state.reason.emplace();
  EXPECT_THAT(GoalAlarms(spec, state), IsEmpty());
}

// Three alarms asked for 20 simulations, and the step that was to be rid of them for 7.
TEST(Alarms, TheNextStepHasNoFewerSimulationsThanTheAlarmsAskFor) {
  Answer answer;
  answer.unsettled = {.num_more = 7};
  EXPECT_EQ(MoreSimulations(answer), 7);
  answer.warnings = {{.kind = AlarmKind::kPoorModel}};
  EXPECT_EQ(MoreSimulations(answer), kMoreSimulations);
  answer.unsettled->num_more = 160;
  EXPECT_EQ(MoreSimulations(answer), 160);
}

TEST(Alarms, ABudgetThatEndedTheSearchSaysHowToGoOn) {
  Answer result;
  EXPECT_THAT(BudgetAlarms(result), IsEmpty());
  result.unsettled = {
      .lacks = optimizer::StopLack::kShare, .why = "they are wide", .num_more = 160};
  EXPECT_THAT(AlarmText(BudgetAlarms(result).at(0)),
              HasSubstr("they are wide (`talus resume DIR --add-simulations 160`)"));
  result.unsettled->num_more = 0;
  EXPECT_FALSE(BudgetAlarms(result).at(0).value);
  EXPECT_THAT(AlarmText(BudgetAlarms(result).at(0)),
              HasSubstr("they are wide (`talus resume DIR --add-simulations 20`)"));
}

// One vocabulary: what measure.json calls a doubt is what result.json calls it.
TEST(Alarms, EveryDoubtOfAPhotographIsAWarningOfTheSameName) {
  for (const auto& [name, doubt] : base::Names<imaging::PhotoDoubt>::kList) {
    const journal::PhotoWarningRecord record{
        .kind = std::string(name), .photo = "a.jpg", .value = 0.5, .text = "words"};
    const Alarm warning = PhotographAlarm(record, "heap");
    EXPECT_EQ(base::NameOf(warning.kind), name);
    EXPECT_EQ(warning.experiment, "heap");
    EXPECT_EQ(warning.photo, "a.jpg");
    EXPECT_EQ(AlarmText(warning), "words");
  }
}

// What the photographs' measurement doubted when the campaign began is there when it concludes.
TEST(Alarms, DoubtsOfPhotographsStandInTheJournal) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "talus_alarms_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  journal::CampaignRecord record;
  record.experiments.resize(2);
  record.experiments[0].name = "heap";
  record.experiments[1].name = "wide plate";
  record.experiments[1].warnings = {
      {.kind = "overexposed", .photo = "b.jpg", .value = 0.6, .text = "b.jpg: too bright"}};
  journal::Journal::Create(journal::JournalPath(folder), record);
  const auto read = journal::Journal::OpenReadOnly(journal::JournalPath(folder)).Campaign();
  EXPECT_THAT(read.experiments[0].warnings, IsEmpty());
  ASSERT_THAT(read.experiments[1].warnings, SizeIs(1));
  EXPECT_EQ(read.experiments[1].warnings[0].kind, "overexposed");
  EXPECT_EQ(read.experiments[1].warnings[0].photo, "b.jpg");
  EXPECT_EQ(read.experiments[1].warnings[0].value, 0.6);
  std::filesystem::remove_all(folder);
}

TEST(Alarms, ARunThatDiffersMoreThanTheOthersDoIsFound) {
  EXPECT_EQ(imaging::DisagreeingRuns({1, 1.2, 0.9, 1.1}), std::vector<double>(4, 0.0));
  const std::vector<double> off = imaging::DisagreeingRuns({1, 1.2, 5, 0.9, 1.1});
  EXPECT_NEAR(off[2], 5 / 1.1, 1e-9);  // the upper middle of the four others
  EXPECT_EQ(off[0], 0);
  EXPECT_EQ(imaging::DisagreeingRuns({1, 9, 1}), std::vector<double>(3, 0.0));  // too few to tell
}

// √(4.2² + 3.5²) for one heap and √(4.2² + 3.5²/3) for three: without scatter 4.2.
TEST(Alarms, TheScatterOfAMeanProfileIsTakenOutOfIt) {
  Answer answer = ConfirmedAt(std::hypot(4.2, 3.5));
  HeapOf(answer).profile_sad_mm2 = std::sqrt(4.2 * 4.2 + 3.5 * 3.5 / 3);
  EXPECT_NEAR(SadWithoutScatter(answer.experiments[0], HeapOf(answer)), 4.2, 1e-9);
}

// A single seed's scatter is a part of its SAD, and was taken for the set's.
TEST(Alarms, OneSeedDoesNotTellThatASetIsWorseThanPredicted) {
  Answer answer = ConfirmedAt(8);
  EXPECT_THAT(PredictionAlarms(answer), SizeIs(1));
  HeapOf(answer).num_trials = 1;
  EXPECT_THAT(PredictionAlarms(answer), IsEmpty());
}

// One photograph of one heap is as far from a mean heap as from another of its kind, and farther
// than pictures of sixteen views are from each other.
TEST(Alarms, ASinglePhotographIsNotMissedForItsOwnScatter) {
  Answer answer = ConfirmedAt(4);
  ResultExperiment& heap = answer.experiments[0];
  heap.powder_area = 40;
  HeapOf(answer).profile_sad_mm2 = 4;
  HeapOf(answer).spread_mm2 = 1.2;
  EXPECT_EQ(ImageFit(answer, heap).meets, Meets::kNo);  // of 2, a twentieth of its area
  heap.views_per_photograph = 16;
  EXPECT_NEAR(SadWithoutScatter(heap, HeapOf(answer)), std::sqrt(16 - 1.2 * 1.2 * 2 / 9), 1e-9);
  EXPECT_EQ(ImageFit(answer, heap).meets, Meets::kUnknown);
  heap.views_per_photograph = 1;
  HeapOf(answer).num_trials = 1;
  EXPECT_EQ(ImageFit(answer, heap).meets, Meets::kUnknown);
}

TEST(Alarms, AnAnswerThreeStandardDeviationsOffContradictsItsPrior) {
  Answer answer;
  answer.parameters = {{.name = "friction", .prior = ResultPrior{.text = "0.3 ± 0.02"}}};
  for (const double offset : {-2.9, 2.9}) {
    answer.parameters[0].prior->offset = offset;
    EXPECT_THAT(PriorAlarms(answer), IsEmpty());
  }
  for (const double offset : {-3.1, 3.1}) {
    answer.parameters[0].prior->offset = offset;
    EXPECT_THAT(PriorAlarms(answer), SizeIs(1));
  }
}

}  // namespace alarms_test
}  // namespace talus::campaign
