#include "imaging/heap/mass_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace talus::imaging {
namespace mass_study_test {

using testing::HasSubstr;

// NEBP [mm²] of runs at one mass, two days of two.
std::vector<MassRun> Runs(double mass, const std::vector<double>& nebp, double base) {
  std::vector<MassRun> runs;
  for (std::size_t i = 0; i < nebp.size(); ++i) {
    runs.push_back({.mass = mass,
                    .day = i < nebp.size() / 2 ? "1" : "2",
                    .run = std::to_string(i),
                    .nebp_mm2 = nebp[i],
                    .base_share = base});
  }
  return runs;
}

std::vector<MassRun> operator+(std::vector<MassRun> a, const std::vector<MassRun>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// 0.8 g does not cover the plate, 1.0 g still grows, 1.2 g is the first that more powder does not
// raise by 3 %.
TEST(MassStudy, SmallestFormedAndRepeatableMassIsChosen) {
  const MassStudy study = StudyMass(
      Runs(0.8e-3, {12, 12.1, 12, 12.1}, 0.9) + Runs(1.0e-3, {16, 16.2, 16.1, 16}, 1) +
      Runs(1.2e-3, {18, 18.2, 18.1, 17.9}, 1) + Runs(1.5e-3, {18.2, 18.1, 18.3, 18.0}, 1));
  ASSERT_EQ(study.rows.size(), 4u);
  EXPECT_EQ(study.chosen, 1.2e-3);
  EXPECT_THAT(study.rows[0].remark, HasSubstr("90 % of the plate"));
  EXPECT_THAT(study.rows[1].remark, HasSubstr("more NEBP"));
  EXPECT_NEAR(study.rows[2].mean_mm2, 18.05, 1e-9);
  EXPECT_NEAR(study.rows[2].sd_mm2, 0.129, 1e-3);  // of 18, 18.2, 18.1, 17.9
  ASSERT_EQ(study.rows[2].days.size(), 2u);
  EXPECT_NEAR(study.rows[2].days[0].mean_mm2, 18.1, 1e-9);
}

TEST(MassStudy, ScatterAndDaysDecideRepeatability) {
  const MassStudy study = StudyMass(Runs(1e-3, {17, 19.5, 17, 19.5}, 1) +
                                    Runs(2e-3, {17.5, 17.6, 18.6, 18.7}, 1) + Runs(3e-3, {18}, 1));
  EXPECT_FALSE(study.chosen);
  EXPECT_THAT(study.rows[0].remark, HasSubstr("standard deviation"));
  EXPECT_THAT(study.rows[1].remark, HasSubstr("between days"));
  EXPECT_THAT(study.rows[2].remark, HasSubstr("one run"));
}

// "In every run": one of four that covers 90 % of the plate is enough.
TEST(MassStudy, TheNarrowestRunDecidesWhetherAHeapIsFormed) {
  std::vector<MassRun> runs = Runs(1e-3, {18, 18.1, 18, 18.1}, 1);
  EXPECT_TRUE(StudyMass(runs).chosen);
  runs[2].base_share = 0.9;
  EXPECT_FALSE(StudyMass(runs).chosen);
}

TEST(MassStudy, OneMassInTwoUnitsIsOneRow) {
  ASSERT_NE(1.1 * 1e-3, 1100 * 1e-6);  // in the last bit
  const MassStudy study =
      StudyMass(Runs(1.1 * 1e-3, {18, 18.2}, 1) + Runs(1100 * 1e-6, {18.1, 17.9}, 1));
  ASSERT_EQ(study.rows.size(), 1u);
  EXPECT_EQ(study.rows[0].num_runs, 4);
}

// Each of its numbers decides: 97 % of the plate is enough, and is too little for a rule of 98.
TEST(MassStudy, EveryNumberOfTheRuleDecides) {
  const auto runs = Runs(1e-3, {17, 17.2, 17.4, 17.6}, 0.97) + Runs(2e-3, {17.8, 17.7}, 1);
  const auto chosen = [&](const MassRule& rule) {
    return StudyMass(runs, rule).chosen.value_or(0);
  };
  EXPECT_EQ(chosen({}), 1e-3);
  EXPECT_EQ(chosen({.least_base = 0.98}), 2e-3);
  EXPECT_EQ(chosen({.largest_gain = 0.02}), 2e-3);  // 17.75 / 17.3 is 1.026
  EXPECT_EQ(chosen({.largest_sd = 0.01}), 2e-3);    // 0.258 / 17.3 is 1.5 %, 0.4 % of the other
  EXPECT_EQ(chosen({.largest_day_change = 0.02}), 2e-3);  // 17.5 / 17.1 is 2.3 %
  EXPECT_THAT(RuleText({.least_base = 0.95,
                        .largest_gain = 0.02,
                        .largest_sd = 0.04,
                        .largest_day_change = 0.06}),
              AllOf(HasSubstr("base at least 95 %"), HasSubstr("more than 2 % more NEBP"),
                    HasSubstr("at most 4 %"), HasSubstr("differ by at most 6 %")));
}

// 9.5 mm wide where it stands, on a plate of 10 mm; what is wider above is not the base.
TEST(MassStudy, TheBaseIsTheWidthAtThePlate) {
  Profile profile{.image = {.width = 120, .height = 80, .pixels = {}},
                  .frame = {.width = 120,
                            .height = 80,
                            .pixel_size = 1e-4,
                            .center_x = 60,
                            .baseline = 76,
                            .plate_diameter = 10e-3}};
  profile.image.pixels.assign(120 * 80, 255);
  for (int y = 40; y < 76; ++y) {
    const int beyond = y < 60 ? 8 : 0;
    for (int x = 13 - beyond; x < 108 + beyond; ++x) profile.image.at(x, y) = 0;
  }
  EXPECT_NEAR(BaseShare(profile), 0.95, 1e-9);
}

TEST(MassStudy, PlotShowsTheRuns) {
  const auto runs = Runs(1e-3, {17, 17.2}, 1) + Runs(2e-3, {18, 18.2}, 1);
  const ColorImage plot = DrawMassStudy(runs, StudyMass(runs));
  // Left of the legend, in the first day's colour: two discs of some 25 pixels.
  int in_plot = 0;
  for (std::size_t i = 0; i < plot.pixels.size(); ++i) {
    const bool is_left = i % static_cast<std::size_t>(plot.width) < 610;
    in_plot += is_left && plot.pixels[i] == Color{31, 119, 180} ? 1 : 0;
  }
  EXPECT_GT(in_plot, 40);
}

}  // namespace mass_study_test
}  // namespace talus::imaging
