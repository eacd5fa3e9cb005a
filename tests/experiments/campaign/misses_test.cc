// Measurements that the recommended set, or one that was simulated again, does not give.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/not_known.h"
#include "experiments/campaign/answer/alarms.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/campaign/answer/headline.h"
#include "tests/experiments/campaign/confirmed_answer.h"

namespace talus::campaign {
namespace misses_test {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A drum confirmed at 47.5° for 44 ± 0.7: 5 standard errors.
TEST(Misses, ANumberThatTheSetMissesIsSaid) {
  Answer answer = ConfirmedAt(4);
  answer.experiments[0].has_image = false;
  answer.experiments[0].numbers = {{.name = "drum_angle_deg", .value = 44, .standard_error = 0.7}};
  HeapOf(answer).scalars = {{.name = "drum_angle_deg", .mean = 45, .standard_error = 0}};
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
  HeapOf(answer).scalars[0].mean = 47.5;
  const auto alarms = MissAlarms(answer);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].kind, AlarmKind::kMisses);
  EXPECT_EQ(alarms[0].number, "drum_angle_deg");
  EXPECT_DOUBLE_EQ(alarms[0].value.value(), 5);
  EXPECT_THAT(AlarmText(alarms[0]),
              HasSubstr("misses drum_angle_deg of \"heap\" by 5 standard errors"));
  // A few simulations that scatter do not tell: 3.5 of √(0.7² + 2.4²) is 1.4.
  HeapOf(answer).scalars[0].standard_error = 2.4;
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
  HeapOf(answer).scalars[0].standard_error = base::kNotKnown;
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
  HeapOf(answer).scalars[0].standard_error = 0;
  // The error of two values may be a fifth of what it seems: 5 of them are no more than chance.
  answer.experiments[0].numbers[0].degrees = 1;
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
  answer.experiments[0].numbers[0].degrees = 0;
  // Where no set fits, that is said instead.
  answer.posterior->experiments[0].implausibility = 3.4;
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
}

// Two numbers of a test that no set fits: one of them is met all the same. Which of measurement and
// simulations leaves the other open is said.
TEST(Misses, ANumberThatIsMetIsSoBesideOneThatIsMissed) {
  Answer answer = ConfirmedAt(4);
  answer.experiments[0].has_image = false;
  answer.experiments[0].numbers = {
      {.name = "poured_density_kg_per_m3", .value = 1420, .standard_error = 14},
      {.name = "hausner_ratio", .value = 1.08, .standard_error = 0.01, .degrees = 2}};
  answer.posterior->experiments[0].implausibility = 3.4;
  HeapOf(answer).scalars = {{.name = "poured_density_kg_per_m3",
                             .num_trials = 3,
                             .mean = 1431,
                             .standard_error = 3,
                             .degrees = 6},
                            {.name = "hausner_ratio",
                             .num_trials = 3,
                             .mean = 1.03,
                             .standard_error = 0.002,
                             .degrees = 6}};
  EXPECT_EQ(NumberFit(answer, answer.experiments[0], 0).meets, Meets::kYes);
  EXPECT_EQ(NumberFit(answer, answer.experiments[0], 1).meets, Meets::kNo);
  answer.posterior->experiments[0].implausibility = 1;
  const MeasurementFit open = NumberFit(answer, answer.experiments[0], 1);
  EXPECT_EQ(open.meets, Meets::kUnknown);  // 5 standard errors of three values
  EXPECT_TRUE(open.few_measured);
}

// A drum whose simulations carry the powder round has no angle to compare.
TEST(Misses, ANumberThatNoSimulationOfTheSetHasIsMissed) {
  Answer answer = ConfirmedAt(4);
  answer.experiments[0].has_image = false;
  answer.experiments[0].numbers = {{.name = "drum_angle_deg", .value = 44, .standard_error = 0.7}};
  answer.posterior->experiments[0].numbers = {{.predicted = 44, .predicted_sd = 1}};
  HeapOf(answer).scalars = {{.name = "drum_angle_deg", .undefined = "the drum carries it round"}};
  const MeasurementFit fit = NumberFit(answer, answer.experiments[0], 0);
  EXPECT_EQ(fit.meets, Meets::kNo);  // though the model expects 44
  EXPECT_TRUE(Misses(answer, answer.confirmed[0]));
  auto alarms = MissAlarms(answer);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_THAT(
      AlarmText(alarms[0]),
      HasSubstr("of \"heap\": simulated with it there is none (the drum carries it round)"));
  // Another one that has it comes nearer.
  answer.parameters = {{.name = "friction"}};
  answer.confirmed.push_back(answer.confirmed[0]);
  answer.confirmed[1].values = {0.3};
  answer.confirmed[1].experiments[0].scalars = {{.name = "drum_angle_deg", .mean = 43}};
  alarms = MissAlarms(answer);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].kind, AlarmKind::kSearchMisses);
}

// Without a model the search is to blame, and a miss is said all the same.
TEST(Misses, AreSaidWithoutAModel) {
  Answer answer = ConfirmedAt(4);
  answer.posterior.reset();
  answer.parameters = {{.name = "friction"}};
  answer.experiments[0].has_image = false;
  answer.experiments[0].numbers = {{.name = "drum_angle_deg", .value = 44, .standard_error = 0.7}};
  HeapOf(answer).scalars = {{.name = "drum_angle_deg", .mean = 54, .standard_error = 1}};
  const auto alarms = MissAlarms(answer);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].kind, AlarmKind::kSearchMisses);
  EXPECT_THAT(AlarmText(alarms[0]), HasSubstr("too few simulations for a model"));
}

// With runs their noise floor decides; with a map the share of the powder's area, unless simulated
// pictures scatter as widely.
TEST(Misses, AnImageThatTheSetMissesIsSaid) {
  Answer answer = ConfirmedAt(300);
  answer.experiments[0].powder_area = 2770;
  HeapOf(answer).profile_sad_mm2 = 294;
  auto alarms = MissAlarms(answer);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_FALSE(alarms[0].value);
  EXPECT_NEAR(alarms[0].share.value(), 294.0 / 2770, 1e-12);
  EXPECT_THAT(AlarmText(alarms[0]), HasSubstr("misses the shape of \"heap\" by 11 % of"));
  // One run in black and white is as far from a mean of many as from another one.
  HeapOf(answer).spread_mm2 = 250;
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
  HeapOf(answer).spread_mm2 = 100;
  EXPECT_THAT(MissAlarms(answer), SizeIs(1));
  HeapOf(answer).profile_sad_mm2 = 180;  // of 300 for one picture: they scatter by 290
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
  HeapOf(answer).profile_sad_mm2 = 100;  // 3.6 % of the area
  HeapOf(answer).sad_mm2 = 105;
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
  HeapOf(answer).over_floor = 2.6;
  alarms = MissAlarms(answer);
  ASSERT_THAT(alarms, SizeIs(1));
  EXPECT_EQ(alarms[0].value, 2.6);
  HeapOf(answer).over_floor = 1.4;
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
}

// A prior may keep the answer from where a set would fit: where the measurements pull against it,
// and where it is narrow.
TEST(Misses, APriorIsSuspectWhereItIsPulledAtOrNarrow) {
  Answer answer = ConfirmedAt(4);
  answer.experiments[0].has_image = false;
  answer.experiments[0].numbers = {{.name = "drum_angle_deg", .value = 44, .standard_error = 0.7}};
  HeapOf(answer).scalars = {{.name = "drum_angle_deg", .mean = 54, .standard_error = 0}};
  answer.parameters = {{.name = "friction",
                        .searched_low = 0.1,
                        .searched_high = 0.9,
                        .prior = ResultPrior{.low = 0.2, .high = 0.8, .offset = -0.3}}};
  ASSERT_THAT(MissAlarms(answer), SizeIs(1));
  EXPECT_FALSE(MissAlarms(answer)[0].parameter);
  answer.parameters[0].prior->offset = -1.6;
  EXPECT_EQ(MissAlarms(answer)[0].parameter, "friction");
  answer.parameters[0].prior = ResultPrior{.low = 0.4, .high = 0.6, .offset = -0.3};
  EXPECT_EQ(MissAlarms(answer)[0].parameter, "friction");
  // Two thirds of three decades, and a tenth of them.
  answer.parameters = {{.name = "adhesion",
                        .searched_low = 1e-3,
                        .searched_high = 1,
                        .scale = optimizer::Scale::kLog,
                        .prior = ResultPrior{.low = 1e-3, .high = 0.1, .offset = -0.3}}};
  EXPECT_FALSE(MissAlarms(answer)[0].parameter);
  answer.parameters[0].prior = ResultPrior{.low = 0.5, .high = 1, .offset = -0.3};
  EXPECT_EQ(MissAlarms(answer)[0].parameter, "adhesion");
}

// A small search confirms 2.7 noise floors. Law and plate are blamed where nothing speaks against
// the search alone.
class MissedImage : public testing::Test {
 protected:
  MissedImage() : answer_(ConfirmedAt(2.6)) {
    answer_.parameters = {{.name = "friction"}, {.name = "rolling"}};
    answer_.experiments[0].noise_floor = 0.9;
    HeapOf(answer_).profile_sad_mm2 = 2.43;
    HeapOf(answer_).over_floor = 2.7;
  }
  Alarm OnlyAlarm() const {
    const auto alarms = MissAlarms(answer_);
    EXPECT_THAT(alarms, SizeIs(1));
    return alarms.empty() ? Alarm{} : alarms.front();
  }
  void AddEnd(double over_floor) {
    answer_.confirmed.push_back({.role = CandidateRole::kEnd,
                                 .values = {0.3, 0.1},
                                 .experiments = {{.name = "heap",
                                                  .num_trials = 3,
                                                  .profile_sad_mm2 = 0.9 * over_floor,
                                                  .over_floor = over_floor}}});
  }
  Answer answer_;
};

TEST_F(MissedImage, IsOfTheSetUpWhereNothingSpeaksAgainstTheSearch) {
  EXPECT_EQ(OnlyAlarm().kind, AlarmKind::kMisses);
  EXPECT_THAT(AlarmText(OnlyAlarm()), HasSubstr("the contact law, the plate and the set-up"));
  AddEnd(2.4);  // no nearer than chance
  EXPECT_EQ(OnlyAlarm().kind, AlarmKind::kMisses);
}

TEST_F(MissedImage, IsOfTheSearchWhereAnotherSetFits) {
  AddEnd(1.2);
  EXPECT_EQ(OnlyAlarm().kind, AlarmKind::kSearchMisses);
  EXPECT_THAT(AlarmText(OnlyAlarm()),
              HasSubstr("(friction 0.3, rolling 0.1), simulated again, too, fits"));
  EXPECT_THAT(AlarmText(OnlyAlarm()), HasSubstr("--add-simulations 20"));
  answer_.warnings = {OnlyAlarm()};
  EXPECT_THAT(HeadlineText(answer_), testing::Not(HasSubstr("Sets are found")));
}

TEST_F(MissedImage, IsOfTheSearchWhereItsModelExpectedAFit) {
  answer_.posterior->experiments[0].predicted = 1.0;  // below 1.5 noise floors
  EXPECT_EQ(OnlyAlarm().kind, AlarmKind::kSearchMisses);
  EXPECT_THAT(AlarmText(OnlyAlarm()), HasSubstr("its model expected this set to fit"));
}

TEST_F(MissedImage, IsOfTheSearchWhereAScaleFactorIsUnlearnt) {
  answer_.posterior->unlearnt_scale_factors = {2};
  EXPECT_EQ(OnlyAlarm().kind, AlarmKind::kSearchMisses);
  EXPECT_THAT(AlarmText(OnlyAlarm()), HasSubstr("at scale factor 2 to tell its bias"));
}

TEST_F(MissedImage, IsOfTheSearchWhereTheRegionIsStillTheSurrogates) {
  answer_.posterior->surrogate_narrowing = 0.5;
  EXPECT_EQ(OnlyAlarm().kind, AlarmKind::kSearchMisses);
}

// An angle measured at 30° ± 0.5°; three seeds of each of three sets scatter by 0.24°.
class MissedAngle : public testing::Test {
 protected:
  // Its only alarm.
  static Alarm Of(const optimizer::NumberStanding& expected, double confirmed) {
    Answer answer = ConfirmedAt(4);
    answer.experiments[0].has_image = false;
    answer.experiments[0].numbers = {{.name = "angle_deg", .value = 30, .standard_error = 0.5}};
    answer.posterior->experiments[0].numbers = {expected};
    HeapOf(answer).scalars = {{.name = "angle_deg",
                               .num_trials = 3,
                               .mean = confirmed,
                               .standard_error = 0.14,
                               .degrees = 6}};
    const auto alarms = MissAlarms(answer);
    EXPECT_THAT(alarms, SizeIs(1));
    return alarms.empty() ? Alarm{} : alarms.front();
  }
};

// The law was blamed for five of twelve campaigns of two parameters that had stopped after 21
// simulations; 20 more of them met the angle.
TEST_F(MissedAngle, IsOfTheSearchWhereItsModelDoesNotKnowTheSetAsWellAsItWasMeasured) {
  const Alarm alarm = Of({.predicted = 31.8, .predicted_sd = 1.75}, 32);
  EXPECT_EQ(alarm.kind, AlarmKind::kSearchMisses);
  EXPECT_THAT(AlarmText(alarm), HasSubstr("too coarse there to tell whether this set fits"));
}

TEST_F(MissedAngle, IsOfTheSearchWhereItsModelExpectedAFit) {
  const Alarm alarm = Of({.predicted = 30.6, .predicted_sd = 0.3}, 32);
  EXPECT_EQ(alarm.kind, AlarmKind::kSearchMisses);
  EXPECT_THAT(AlarmText(alarm), HasSubstr("its model expected this set to fit"));
}

// A law that ends at 28°, and one that begins at 31.5°.
TEST_F(MissedAngle, IsOfTheSetUpWhereTheModelKnowsThatItIsNotReached) {
  EXPECT_EQ(Of({.predicted = 28.2, .predicted_sd = 0.56}, 27.9).kind, AlarmKind::kMisses);
  EXPECT_EQ(Of({.predicted = 31.3, .predicted_sd = 0.18}, 31.6).kind, AlarmKind::kMisses);
  EXPECT_EQ(Of({.predicted = 30.9, .predicted_sd = 0.4}, 31.5).kind, AlarmKind::kMisses);
}

// A heap of grains twice as large may miss what true ones would meet; true ones have no such
// excuse.
TEST_F(MissedImage, MayBeOfCoarseGrains) {
  const auto has_finer = HasSubstr("grains 2 times as large as yours may be what misses it");
  EXPECT_THAT(AlarmText(OnlyAlarm()), testing::Not(HasSubstr("as large as yours")));
  answer_.conditions.scale_factor = 2;
  // Simulated again at another scale factor, it says nothing of the answer's.
  EXPECT_THAT(MissAlarms(answer_), IsEmpty());
  answer_.confirmed[0].scale_factor = 2;
  EXPECT_THAT(AlarmText(OnlyAlarm()), has_finer);
  AddEnd(1.2);
  answer_.confirmed[1].scale_factor = 2;
  EXPECT_EQ(OnlyAlarm().kind, AlarmKind::kSearchMisses);
  EXPECT_THAT(AlarmText(OnlyAlarm()), has_finer);
}

// What is shown as fitting equally is held to the same bounds as the recommended set.
TEST(Misses, ASetThatWasSimulatedAgainIsJudgedByItsImageAndItsNumbers) {
  Answer answer = ConfirmedAt(4);
  answer.experiments[0].numbers = {
      {.name = "mass_fallen_kg", .value = 5e-6, .standard_error = 1e-6}};
  ResultCandidate end{.role = CandidateRole::kEnd,
                      .experiments = {{.name = "heap",
                                       .num_trials = 3,
                                       .profile_sad_mm2 = 1.0,
                                       .over_floor = 1.4,
                                       .scalars = {{.name = "mass_fallen_kg", .mean = 6e-6}}}}};
  EXPECT_FALSE(Misses(answer, end));
  end.experiments[0].over_floor = 1.6;
  EXPECT_TRUE(Misses(answer, end));
  end.experiments[0].over_floor = 1.4;
  end.experiments[0].scalars[0].mean = 7.5e-6;  // 2.5 standard errors
  EXPECT_TRUE(Misses(answer, end));
  end.experiments[0].over_floor = 1.6;  // both, the number by more
  const std::vector<MeasurementFit> distances = DistancesOf(answer, end);
  ASSERT_THAT(distances, SizeIs(2));
  EXPECT_EQ(distances[0].number, "mass_fallen_kg");
  EXPECT_DOUBLE_EQ(distances[0].off, 1.25);
  EXPECT_DOUBLE_EQ(distances[1].off, 1.6 / kCloseRuns);
  answer.posterior->experiments.clear();  // held out: nothing is asked of it
  EXPECT_FALSE(Misses(answer, end));
}

// The measurements say nothing of a parameter whose range is its prior's, and its unit is said.
TEST(HeadlineOfAPrior, WhatWasKnownBeforehandIsNotCalledDetermined) {
  Answer answer = ConfirmedAt(4);
  answer.parameters = {{.name = "sliding_friction",
                        .value = 0.451,
                        .searched_low = 0,
                        .searched_high = 1,
                        .credible_low = 0.411,
                        .credible_high = 0.489},
                       {.name = "surface_energy",
                        .unit = "J/m^2",
                        .value = 0.002,
                        .searched_low = 0,
                        .searched_high = 0.1,
                        .credible_low = 0.001,
                        .credible_high = 0.003}};
  answer.posterior->branches = {{.share = 1}};
  EXPECT_THAT(HeadlineText(answer), HasSubstr("sliding_friction 0.451 (90 %: 0.411 to 0.489)"));
  answer.parameters[0].prior = {
      .text = "0.45 ± 0.02", .low = 0.4153, .high = 0.4818, .offset = 0.05};
  EXPECT_THAT(HeadlineText(answer), HasSubstr("They determine surface_energy 0.002 J/m² (90 %: "
                                              "0.001 to 0.003 J/m²). The measurements add nothing "
                                              "to what the prior says of sliding_friction (0.45 ± "
                                              "0.02)."));
  answer.parameters[0].prior->offset = -1.5;  // as narrow, but elsewhere
  EXPECT_THAT(HeadlineText(answer), HasSubstr("sliding_friction 0.451 (90 %"));
}

// 1.5 noise floors are 6 of the mean profile's 8 mm²; 2 beyond them are 4.6 of the model's standard
// errors where one simulation scatters by 0.75, and 2.3 where it scatters by 1.5.
TEST(Misses, AnImageIsMissedFromThreeStandardErrorsOn) {
  Answer answer = ConfirmedAt(8);
  HeapOf(answer).profile_sad_mm2 = 8;
  HeapOf(answer).over_floor = 2;
  answer.experiments[0].noise_sd = 0.75;
  EXPECT_THAT(MissAlarms(answer), SizeIs(1));
  answer.experiments[0].noise_sd = 1.5;
  EXPECT_THAT(MissAlarms(answer), IsEmpty());
}

TEST(Misses, ASetOfCoarserGrainsIsNotSaidToMiss) {
  Answer answer = ConfirmedAt(4);
  answer.experiments[0].numbers = {{.name = "drum_angle_deg", .value = 44, .standard_error = 0.7}};
  HeapOf(answer).scalars = {{.name = "drum_angle_deg", .mean = 54, .standard_error = 0}};
  answer.conditions.scale_factor = 1;
  EXPECT_TRUE(Misses(answer, answer.confirmed[0]));
  answer.confirmed[0].scale_factor = 2;
  EXPECT_FALSE(Misses(answer, answer.confirmed[0]));
}

}  // namespace misses_test
}  // namespace talus::campaign
