#include "experiments/campaign/alarms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <set>

#include "experiments/campaign/answer/best_confirmed.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/journal/journal.h"
#include "imaging/photos/photo_warning.h"

namespace talus::campaign {
namespace {

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

// Predicted 4 ± 0.1 where one simulation scatters by 0.3.
CampaignResult ResultConfirmedAt(double mean) {
  CampaignResult result;
  result.predicted = 4;
  result.predicted_sd = 0.1;
  result.noise_sd = 0.3;
  result.confirmed = {
      {.values = {}, .scale_factor = 1, .num_trials = 3, .mean = mean, .standard_error = 0.2}};
  return result;
}

TEST(Alarms, ConfirmedWorseThanPredictedIsSaid) {
  // Twice √(0.2² + 0.1²) is 0.45.
  EXPECT_THAT(DisappointmentAlarms(ResultConfirmedAt(4.3), {}, EmptyReference()), IsEmpty());
  const auto alarms = DisappointmentAlarms(ResultConfirmedAt(7.99), {}, EmptyReference());
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].kind, WarningKind::kWorseThanPredicted);
  EXPECT_NEAR(*alarms[0].value, 3.99, 1e-9);
  EXPECT_THAT(alarms[0].text,
              HasSubstr("misses the experiment by 8, 4 more than the model predicted"));
}

// Runs of the experiment differ by 3: what is 0.6 above the prediction is lost in that.
TEST(Alarms, AnExcessFarBelowTheNoiseFloorIsNoAlarm) {
  CampaignResult result = ResultConfirmedAt(4.6);
  EXPECT_THAT(DisappointmentAlarms(result, {}, EmptyReference()), SizeIs(1));
  result.noise_floor = 3;
  EXPECT_THAT(DisappointmentAlarms(result, {}, EmptyReference()), IsEmpty());
}

// A prediction of the mean heap is held against the mean profile, not against runs that scatter.
TEST(Alarms, MeanProfileAsPredictedIsNoAlarm) {
  CampaignResult result = ResultConfirmedAt(5.5);
  result.confirmed[0].profile_sad_mm2 = 4.1;
  EXPECT_THAT(DisappointmentAlarms(result, {}, EmptyReference()), IsEmpty());
}

// Mean profiles of three heaps scatter, too: √(4.2² + 3.5²) = 5.47 for one heap, √(4.2² + 3.5²/3) =
// 4.66 for three, 0.66 above the prediction, of which 0.2 are the set's.
TEST(Alarms, ScatterOfTheMeanProfileIsNoAlarm) {
  CampaignResult result = ResultConfirmedAt(5.47);
  result.confirmed[0].profile_sad_mm2 = 4.66;
  EXPECT_THAT(DisappointmentAlarms(result, {}, EmptyReference()), IsEmpty());
}

TEST(Alarms, ATrialThatCameOutBetterIsNamed) {
  CampaignResult result = ResultConfirmedAt(4.2);
  const Reference reference = EmptyReference();
  // Twice √(0.2² + 0.3²) is 0.72: 3.6 may be luck, 3.0 is not. Coarse grains make another heap.
  EXPECT_THAT(DisappointmentAlarms(result, {TrialWith(1, 3.6)}, reference), IsEmpty());
  EXPECT_THAT(DisappointmentAlarms(result, {TrialWith(1, 1.0, 2)}, reference), IsEmpty());
  const auto alarms =
      DisappointmentAlarms(result, {TrialWith(1, 3.6), TrialWith(7, 3.0)}, reference);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].kind, WarningKind::kWorseThanObserved);
  EXPECT_EQ(alarms[0].trial, 7);
  EXPECT_THAT(alarms[0].text, HasSubstr("trial 7 came out better"));
}

TEST(Alarms, UnconfirmedPredictionIsHeldAgainstTheTrials) {
  CampaignResult result = ResultConfirmedAt(0);
  result.confirmed.clear();
  result.conditions.scale_factor = 1;
  EXPECT_THAT(DisappointmentAlarms(result, {TrialWith(3, 2.0)}, EmptyReference()), SizeIs(1));
}

TEST(Alarms, ModelThatPredictsBadlyIsSaid) {
  optimizer::Answer answer;
  EXPECT_THAT(ModelAlarms(answer), IsEmpty());  // not known
  answer.left_out_share = 0.4;
  EXPECT_THAT(ModelAlarms(answer), IsEmpty());
  answer.left_out_share = 0.95;
  ASSERT_THAT(ModelAlarms(answer), SizeIs(1));
  EXPECT_EQ(ModelAlarms(answer)[0].kind, WarningKind::kPoorModel);

  answer.posterior.emplace();
  answer.posterior->num_left_out = 40;
  answer.posterior->raw_coverage = 0.88;
  EXPECT_THAT(ModelAlarms(answer), IsEmpty());
  answer.posterior->raw_coverage = 0.5;
  ASSERT_THAT(ModelAlarms(answer), SizeIs(1));
  EXPECT_THAT(ModelAlarms(answer)[0].text, HasSubstr("50 % lay within its 90 % regions"));
}

// Sliding friction from 0 to 1 and surface energy from 1 µJ/m² to 100 µJ/m², logarithmic;
// restitution is fixed between them.
optimizer::ParameterSpace TwoFree() {
  return {{{.name = "sliding_friction", .low = 0, .high = 1},
           {.name = "restitution", .fixed = 0.4},
           {.name = "surface_energy", .low = 1e-6, .high = 1e-4, .scale = optimizer::Scale::kLog}}};
}

CampaignResult ResultWithSet(double sliding, double energy) {
  CampaignResult result;
  result.parameters = {{.name = "sliding_friction", .unit = {}, .value = sliding},
                       {.name = "surface_energy", .unit = "J/m²", .value = energy}};
  return result;
}

// 0.5 % of a range is an end of it; of a logarithmic one, of its logarithm.
TEST(Alarms, AParameterOnTheEndOfItsRangeIsSaid) {
  EXPECT_THAT(BoundAlarms(ResultWithSet(0.5, 1e-5), TwoFree()), IsEmpty());
  EXPECT_THAT(BoundAlarms(ResultWithSet(0.01, 1.1e-6), TwoFree()), IsEmpty());
  const auto alarms = BoundAlarms(ResultWithSet(0.998, 1.01e-6), TwoFree());
  ASSERT_THAT(alarms, SizeIs(2));
  EXPECT_EQ(alarms[0].kind, WarningKind::kBound);
  EXPECT_EQ(alarms[0].parameter, "sliding_friction");
  EXPECT_EQ(alarms[0].side, "upper");
  EXPECT_EQ(alarms[0].text, "sliding_friction lies on its upper bound: widen its range");
  EXPECT_EQ(alarms[1].parameter, "surface_energy");
  EXPECT_EQ(alarms[1].side, "lower");
}

TEST(Alarms, ParametersKnownTogetherOnlyAreSaidUnlessTheAnswerIsAPoint) {
  CampaignResult result = ResultWithSet(0.5, 1e-5);
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
    EXPECT_EQ(alarms[0].kind, WarningKind::kCorrelated);
    EXPECT_EQ(alarms[0].value, -0.93);
    EXPECT_THAT(alarms[0].text, HasSubstr("sliding_friction and surface_energy are known together"
                                          " only (correlation -0.93)"));
  }
  result.correlation = {{1, -0.7}, {-0.7, 1}};
  EXPECT_THAT(CorrelationAlarms(result), IsEmpty());
}

// Sets 1 and 2, with three runs each: 5 ± 0.2, and another mean ± 0.3.
CampaignResult ResultWithRivalAt(double mean) {
  CampaignResult result = ResultWithSet(0.3, 1e-5);
  result.confirmed = {
      {.values = {0.3, 1e-5}, .num_trials = 3, .mean = 5, .standard_error = 0.2},
      {.values = {0.6, 2e-5}, .num_trials = 3, .mean = mean, .standard_error = 0.3}};
  TakeBestConfirmed(result);
  return result;
}

TEST(Alarms, ACandidateConfirmedClearlyBetterIsRecommendedAndThatIsSaid) {
  // Twice √(0.2² + 0.3²) is 0.72.
  const CampaignResult kept = ResultWithRivalAt(4.4);
  EXPECT_THAT(kept.warnings, IsEmpty());
  EXPECT_EQ(kept.parameters[0].value, 0.3);
  const CampaignResult taken = ResultWithRivalAt(4.2);
  ASSERT_THAT(taken.warnings, SizeIs(1));
  EXPECT_EQ(taken.warnings[0].kind, WarningKind::kNotModelsChoice);
  EXPECT_EQ(taken.parameters[0].value, 0.6);
  EXPECT_EQ(taken.parameters[1].value, 2e-5);
  EXPECT_EQ(taken.confirmed[0].mean, 4.2);
  EXPECT_EQ(taken.confirmed[1].mean, 5);
}

// Those of photographs come with words; each other kind has its own.
TEST(Alarms, EveryKindHasWordsOfItsOwn) {
  std::set<std::string> texts;
  int of_results = 0;
  for (const auto& [name, kind] : base::Names<WarningKind>::kList) {
    if (kind == WarningKind::kLeftOut) break;
    ++of_results;
    texts.insert(Worded({.kind = kind}).text);
  }
  EXPECT_EQ(of_results, 13);
  EXPECT_THAT(texts, SizeIs(13));
  EXPECT_FALSE(texts.contains(""));
}

TEST(Alarms, CommandsNameTheFolderWhereTheyAreShown) {
  EXPECT_EQ(WithFolder("try `talus resume DIR --add-simulations 20` or `talus next DIR`", "runs/a"),
            "try `talus resume runs/a --add-simulations 20` or `talus next runs/a`");
  EXPECT_EQ(WithFolder("talus card DIR", "my runs/it's $a"), "talus card 'my runs/it'\\''s $a'");
  EXPECT_EQ(WithFolder("in DIR, talus report DIRECTORY", "a"), "in DIR, talus report DIRECTORY");
}

TEST(Alarms, ABudgetThatEndedTheSearchSaysHowManyMoreWouldSettleIt) {
  CampaignResult result;
  EXPECT_THAT(BudgetAlarms(result), IsEmpty());
  result.unsettled = {.why = "it is far off", .share = 0.1, .num_more = 160};
  EXPECT_THAT(BudgetAlarms(result).at(0).text,
              HasSubstr("it is far off; about 160 more simulations would meet it (`talus resume "
                        "DIR --add-simulations 160`)"));
  result.unsettled->num_more = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(BudgetAlarms(result).at(0).value);
  EXPECT_THAT(BudgetAlarms(result).at(0).text,
              HasSubstr("go on with more simulations (`talus resume DIR --add-simulations 20`)"));
}

// One vocabulary: what measure.json calls a doubt is what result.json calls it.
TEST(Alarms, EveryDoubtOfAPhotographIsAWarningOfTheSameName) {
  for (const auto& [name, doubt] : base::Names<imaging::PhotoDoubt>::kList) {
    const journal::PhotoWarningRecord record{
        .kind = std::string(name), .photo = "a.jpg", .value = 0.5, .text = "words"};
    const ResultWarning warning = PhotographWarning(record, "heap");
    EXPECT_EQ(base::NameOf(warning.kind), name);
    EXPECT_EQ(warning.experiment, "heap");
    EXPECT_EQ(warning.photo, "a.jpg");
    EXPECT_EQ(Worded(warning).text, "words");
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

TEST(Verdict, EndsOfABentValleyAreItsRepresentatives) {
  Eigen::MatrixXd valley(500, 2);
  for (Eigen::Index i = 0; i < valley.rows(); ++i) {
    const double along = static_cast<double>(i) / 499;
    valley.row(i) << 0.1 + 0.8 * along, 0.9 - 0.8 * along * along;
  }
  const Eigen::Vector2d recommended(0.5, 0.7);
  const auto sets = RepresentativeSets(valley, recommended);
  ASSERT_EQ(sets.size(), 3u);
  EXPECT_EQ(sets[1], recommended);
  // Each end is the middle of the points between the outermost 4 % and 12 %, some 0.07 of the way.
  const double from = std::min(sets[0][0], sets[2][0]);
  const double to = std::max(sets[0][0], sets[2][0]);
  EXPECT_NEAR(from, 0.16, 0.03);
  EXPECT_NEAR(to, 0.84, 0.03);
  EXPECT_THAT(RepresentativeSets(0.1 * valley, recommended), SizeIs(1));
}

}  // namespace
}  // namespace talus::campaign
