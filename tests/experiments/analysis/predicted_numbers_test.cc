// What draws and single runs say of a number: its spread, the surrogate over the draws, and the
// regimes beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "base/files/checked_text.h"
#include "base/json/json_writer.h"
#include "base/not_known.h"
#include "base/random.h"
#include "experiments/analysis/predict/draws.h"
#include "experiments/analysis/predict/number_surrogate.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/predict/regimes.h"
#include "experiments/analysis/predict/spread.h"
#include "experiments/analysis/predict/surrogate_answer.h"
#include "experiments/journal/record_json.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::analysis {
namespace predicted_numbers_test {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Means 2 and 6, within-draw variance 2, mean square between 16: σ_a² = (16 − 2)/2.
TEST(Spread, OfABalancedDesignIsTheAnalysisOfVariance) {
  const Spread spread({.runs = {{1, 3}, {5, 7}}, .weight = {0.5, 0.5}});
  EXPECT_DOUBLE_EQ(spread.mean(), 4);
  EXPECT_NEAR(spread.run_sd(), std::sqrt(2), 1e-12);
  EXPECT_NEAR(spread.parameters_sd(), std::sqrt(7), 1e-12);
  EXPECT_NEAR(spread.ParametersShare(), 7.0 / 9, 1e-12);
  EXPECT_NEAR(spread.Ninety().low + spread.Ninety().high, 2 * 4, 1e-6);  // symmetric
}

// The run after two lies within 6.314 √(1 + ½) of their standard deviations from their mean in 90 %
// of cases: Student's t of one degree of freedom.
TEST(Spread, TwoRunsSayLittleOfTheNext) {
  const Spread spread({.runs = {{1, 3}}, .weight = {1}});
  EXPECT_NEAR(spread.Ninety().high, 2 + 6.314 * std::sqrt(2) * std::sqrt(1.5), 0.01);
}

TEST(Spread, WhatDoesNotDifferBetweenDrawsIsNotOfTheParameters) {
  const Spread spread({.runs = {{1, 3}, {3, 1}, {}}, .weight = {0.2, 0.3, 0.5}});
  EXPECT_EQ(spread.parameters_sd(), 0);
  EXPECT_EQ(spread.ParametersShare(), 0);
  EXPECT_DOUBLE_EQ(spread.mean(), 2);  // a draw without values does not count
}

TEST(Spread, RoundingIsNoScatter) {
  const Spread spread({.runs = {{1, 1 + 1e-15}, {1, 1 - 1e-15}}, .weight = {0.5, 0.5}});
  EXPECT_EQ(spread.run_sd(), 0);
  EXPECT_EQ(spread.parameters_sd(), 0);
  EXPECT_TRUE(std::isnan(spread.ParametersShare()));
}

// A run whose number is not defined is null in prediction.json; the next command reads it back.
TEST(PredictedNumber, WithARunThatHasNoneIsReadAsItWasWritten) {
  PredictedNumber number{.name = "angle_deg"};
  number.by_run = {41.5, base::kNotKnown, 43};
  const std::string text = base::ToJson(number).dump();
  EXPECT_THAT(text, HasSubstr("[41.5,null,43.0]"));
  const auto read = journal::ParseRecord<PredictedNumber>(text, "prediction.json");
  ASSERT_EQ(read.by_run.size(), 3U);
  EXPECT_EQ(read.by_run[0], 41.5);
  EXPECT_TRUE(std::isnan(read.by_run[1]));
  EXPECT_EQ(read.by_run[2], 43);
}

// Runs of 0.97 ± 0.04 and at most 1, as coverages are: the normals reach 1.06.
TEST(Spread, ARangeEndsWhereTheNumberDoes) {
  const DrawValues coverage{.runs = {{0.9, 1, 1}, {1, 0.95, 0.98}, {1, 0.92, 1}},
                            .weight = {0.3, 0.4, 0.3}};
  const rigs::Bounds bounds = rigs::BoundsOf("coverage");
  EXPECT_GT(Spread(coverage).Ninety().high, 1.02);
  const Range range = Spread(coverage, bounds).Ninety();
  EXPECT_EQ(range.high, 1);
  EXPECT_EQ(range.low, Spread(coverage).Ninety().low);  // the tail at the other side stays
  // A measurement of it may err beyond, by its own error: 1.645 of 0.01 in 90 %.
  EXPECT_NEAR(Spread(coverage, bounds).Ninety(0.01).high, 1.01645, 1e-4);
  const DrawValues fallen{.runs = {{0, 0, 3e-6}, {0, 1e-6, 0}}, .weight = {0.5, 0.5}};
  EXPECT_LT(Spread(fallen).Ninety().low, 0);
  EXPECT_EQ(Spread(fallen, rigs::BoundsOf("mass_fallen_kg")).Ninety().low, 0);
}

TEST(Spread, OfOneRunHasNoWidth) {
  const Spread one({.runs = {{0.7}, {}}, .weight = {0.5, 0.5}});
  EXPECT_EQ(one.mean(), 0.7);
  EXPECT_TRUE(std::isnan(one.Ninety().low));
  EXPECT_TRUE(std::isnan(one.Ninety(0.1).high));
  EXPECT_TRUE(std::isnan(one.ParametersShare()));
  EXPECT_TRUE(std::isfinite(Spread({.runs = {{0.7}, {0.6}}, .weight = {0.5, 0.5}}).Ninety().low));
}

// Four runs of one set that scatter by 2: a mean of many lies within 2/√4 of theirs, a single one
// within √5 times as much.
TEST(Spread, OfMeansIsWithoutTheScatterOfRuns) {
  const double far = 2 * std::sqrt(3.0) / 2;
  const Spread spread({.runs = {{10 - far, 10 - far, 10 + far, 10 + far}}, .weight = {1}});
  EXPECT_NEAR(spread.run_sd(), 2, 1e-12);
  const Range single = spread.Ninety(), means = spread.OfMeans().Ninety();
  EXPECT_NEAR((single.high - 10) / (means.high - 10), std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(spread.OfMeans().Ninety(100).high - 10, 1.645 * 100, 0.2);  // the measurement's own
}

TEST(Bounds, AreInTheUnitOfResults) {
  EXPECT_NEAR(rigs::BoundsOf("angle_deg").high, 90, 1e-9);
  EXPECT_EQ(rigs::BoundsOf("packing_fraction").high, 1);
  EXPECT_EQ(rigs::BoundsOf("mass_per_area_kg_per_m2").low, 0);
  EXPECT_LT(rigs::BoundsOf("cohesion_pa").low, -1e9);       // a line's, which may pass below 0
  EXPECT_LT(rigs::BoundsOf("their own number").low, -1e9);  // of another engine
}

// 2000 predictions of 12 draws and 3 runs each: seen 90.8 %, with a standard error of 0.7 %. A
// range of the runs' scatter alone, or of the parameters' alone, would hold 75 %.
TEST(Spread, NinetyPerCentHoldTheNextRunInNinetyPerCentOfCases) {
  int inside = 0;
  constexpr int kCases = 2000;
  for (int c = 0; c < kCases; ++c) {
    base::Random random(1, base::Stream("spread test"), static_cast<std::uint64_t>(c));
    DrawValues values{.runs = std::vector<std::vector<double>>(12),
                      .weight = std::vector<double>(12, 1.0 / 12)};
    for (std::vector<double>& runs : values.runs) {
      const double centre = random.Normal();
      for (int k = 0; k < 3; ++k) runs.push_back(centre + random.Normal());
    }
    const Spread spread(values);
    const double next = random.Normal() + random.Normal();
    inside += next > spread.Ninety().low && next < spread.Ninety().high;
  }
  EXPECT_NEAR(static_cast<double>(inside) / kCases, 0.90, 0.025);
}

// Seven tenths of the posterior stand at one corner, the others at the opposite one.
TEST(Draws, StandForTheWholePosteriorWithTheirWeights) {
  Eigen::MatrixXd all(1000, 2);
  base::Random random(3, base::Stream("draws test"));
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    const double corner = i < 700 ? 0.1 : 0.9;
    all.row(i) << corner + 0.05 * random.Normal(), corner + 0.05 * random.Normal();
  }
  const WeightedDraws few = ChooseDraws(all, 12, 1);
  ASSERT_EQ(few.points.size(), 12u);
  EXPECT_NEAR(std::accumulate(few.weights.begin(), few.weights.end(), 0.0), 1, 1e-12);
  double near = 0;
  double mean = 0;
  for (std::size_t i = 0; i < few.points.size(); ++i) {
    if (few.points[i][0] < 0.5) near += few.weights[i];
    mean += few.weights[i] * few.points[i][0];
  }
  EXPECT_NEAR(near, 0.7, 1e-12);
  EXPECT_NEAR(mean, all.col(0).mean(), 0.02);
  EXPECT_EQ(ChooseDraws(all, 12, 1).points, few.points);
  EXPECT_EQ(ChooseDraws(Eigen::MatrixXd::Constant(50, 2, 0.3), 12, 1).points.size(), 1u);
}

// A number over two parameters, bent, that coarse grains raise; 12 draws of a posterior that is a
// fifth of the ranges wide, three runs of each at scale factor 2 and one of eight at 1.5, told
// at 1.
class MadeUpProcess {
 public:
  explicit MadeUpProcess(int number)
      : random_(2, base::Stream("made-up process"), static_cast<std::uint64_t>(number)),
        slope_(random_.Normal()),
        across_(random_.Normal()),
        bend_(random_.Normal()),
        shift_(random_.Normal()) {}

  static optimizer::ParameterSpace Space() {
    return {.parameters = {{.name = "a", .low = 0, .high = 1}, {.name = "b", .low = 0, .high = 1}}};
  }
  Eigen::RowVector2d Set() { return {0.5 + 0.1 * random_.Normal(), 0.5 + 0.1 * random_.Normal()}; }
  double Run(const Eigen::RowVector2d& set, double scale_factor) {
    const double x = 10 * (set[0] - 0.5);
    const double y = 10 * (set[1] - 0.5);
    return 5 + slope_ * x + 0.5 * across_ * y + 0.2 * bend_ * x * x + shift_ * (scale_factor - 1) +
           0.3 * std::pow(scale_factor, 1.5) * random_.Normal();
  }
  Prediction Runs() {
    Prediction p{.scale_factor = 2, .target = 1, .numbers = {{.name = "made up"}}};
    std::vector<Eigen::RowVector2d> sets;
    for (int d = 0; d < 12; ++d) {
      sets.push_back(Set());
      p.draws.push_back({.weight = 1.0 / 12, .values = {sets.back()[0], sets.back()[1]}});
    }
    DrawValues values{.runs = std::vector<std::vector<double>>(12),
                      .weight = std::vector<double>(12, 1.0 / 12)};
    const auto add = [&](int draw, double scale_factor) {
      p.runs.push_back({.draw = draw, .scale_factor = scale_factor});
      const auto place = static_cast<std::size_t>(draw);
      p.numbers[0].by_run.push_back(Run(sets[place], scale_factor));
      if (scale_factor == 2) values.runs[place].push_back(p.numbers[0].by_run.back());
    };
    for (int run = 0; run < 36; ++run) add(run % 12, 2);
    for (int run = 0; run < 8; ++run) add(run, 1.5);
    spread_.emplace(values);
    Take(*spread_, p.numbers[0]);
    p.numbers[0].repeats_sd = spread_->run_sd();
    return p;
  }
  std::optional<Spread>& spread() { return spread_; }

 private:
  base::Random random_;
  double slope_, across_, bend_, shift_;
  std::optional<Spread> spread_;
};

// The share among 150 such processes has a standard error of 2.5 %. The draws at scale factor 2
// alone scatter more and do not know the shift.
TEST(Surrogate, NinetyPerCentHoldTheNextRunAtAScaleFactorThatNobodySimulated) {
  int inside = 0;
  double width = 0;
  double width_of_draws = 0;
  int used = 0;
  constexpr int kCases = 150;
  for (int c = 0; c < kCases; ++c) {
    MadeUpProcess process(c);
    Prediction p = process.Runs();
    const PredictedNumber by_draws = p.numbers[0];
    Eigen::MatrixXd posterior(200, 2);
    for (Eigen::Index i = 0; i < posterior.rows(); ++i) posterior.row(i) = process.Set();
    PredictedNumber number = p.numbers[0];
    const optimizer::ParameterSpace space = MadeUpProcess::Space();
    AnswerBySurrogate(p, {.space = space, .points = posterior}, number, process.spread());
    const double next = process.Run(process.Set(), 1);
    used += number.surrogate->is_used;
    inside += next > number.low && next < number.high;
    width += number.high - number.low;
    width_of_draws += by_draws.high - by_draws.low;
  }
  EXPECT_GT(used, 0.9 * kCases);
  EXPECT_NEAR(static_cast<double>(inside) / kCases, 0.90, 0.06);
  EXPECT_LT(width, 0.9 * width_of_draws);
}

// Three runs at 1.5 do not show what the scale factor changes: the number is told at 2, where all
// draws ran, and by the runs there alone.
TEST(Surrogate, FewerThanFourRunsAtAFinerScaleFactorDoNotCarryTheNumberOn) {
  MadeUpProcess process(1);
  Prediction p = process.Runs();
  const auto number_with = [&](std::size_t num_runs) {
    p.runs.resize(num_runs);
    PredictedNumber number = p.numbers[0];
    number.by_run.resize(num_runs);
    std::optional<Spread> spread = process.spread();
    AnswerBySurrogate(
        p, {.space = MadeUpProcess::Space(), .points = Eigen::MatrixXd::Constant(1, 2, 0.5)},
        number, spread);
    return number;
  };
  EXPECT_EQ(number_with(36 + 4).surrogate->scale_factor, 1);
  const PredictedNumber by_three = number_with(36 + 3);
  EXPECT_EQ(by_three.surrogate->scale_factor, 2);
  EXPECT_EQ(by_three.surrogate->left_out_error, number_with(36).surrogate->left_out_error);
}

// Twelve draws along a line of which the last third covers the plate: a plane through them would go
// on to 1.5 at its end.
TEST(Surrogate, TellsNoShareAboveOne) {
  Prediction p{.scale_factor = 1, .target = 1, .numbers = {{.name = "coverage"}}};
  for (int d = 0; d < 12; ++d) {
    const double a = d / 11.0;
    p.draws.push_back({.weight = 1.0 / 12, .values = {a, 0.5}});
    for (int k = 0; k < 2; ++k) {
      p.runs.push_back({.draw = d, .scale_factor = 1});
      p.numbers[0].by_run.push_back(std::min(1.0, 0.5 + 0.8 * a + 0.002 * k));
    }
  }
  const optimizer::ParameterSpace space = MadeUpProcess::Space();
  const auto surrogate = NumberSurrogate::Fit(p, p.numbers[0], space);
  ASSERT_TRUE(surrogate.has_value());
  Eigen::MatrixXd line(41, 2);
  for (Eigen::Index i = 0; i < line.rows(); ++i) {
    line.row(i) << static_cast<double>(i) / 40, 0.5;
  }
  const surrogate::Predictions at = surrogate->At(line);
  EXPECT_EQ(at.mean.maxCoeff(), 1);
  p.numbers[0].name = "their own number";  // without bounds
  EXPECT_GT(NumberSurrogate::Fit(p, p.numbers[0], space)->At(line).mean.maxCoeff(), 1);
}

FlowRegime Sheared(const std::string& name, bool is_process, double number, double pressure) {
  return {.name = name,
          .is_process = is_process,
          .inertial_number = {number / 2, number, 2 * number},
          .pressure = {pressure / 2, pressure, 2 * pressure},
          .contact_duration = {1e-3, 2e-3, 4e-3},
          .bond_number = 5};
}

TEST(Regimes, AProcessThatNoTestReachesIsWarnedOf) {
  const auto warnings = [](double number, double pressure) {
    return RegimeWarnings({Sheared("drum", true, number, pressure),
                           Sheared("heap", false, 1e-3, 10), Sheared("box", false, 1e-2, 50)});
  };
  EXPECT_THAT(warnings(5e-3, 20), testing::IsEmpty());
  EXPECT_THAT(warnings(0.055, 290), testing::IsEmpty());  // within 3 times 0.02 and 100
  ASSERT_EQ(warnings(0.1, 20).size(), 1u);
  EXPECT_THAT(warnings(0.1, 20)[0],
              HasSubstr("drum shears at an inertial number of 0.1, your tests at most at 0.02"));
  EXPECT_THAT(warnings(5e-3, 1)[0], HasSubstr("a pressure of 1 Pa, your tests at least at 5 Pa"));
  EXPECT_THAT(RegimeWarnings({Sheared("drum", true, 1, 1)}), testing::IsEmpty());  // no test known
}

// Far below 1 a contact's duration does not count, however far the tests are from it; on another
// planet grains weigh less.
TEST(Regimes, SoftContactsAndAnotherWeightAreWarnedOf) {
  FlowRegime process = Sheared("drum", true, 5e-3, 20);
  const auto warnings = [&] { return RegimeWarnings({process, Sheared("heap", false, 5e-3, 20)}); };
  process.contact_duration = {0.01, 0.05, 0.1};
  EXPECT_THAT(warnings(), testing::IsEmpty());
  process.contact_duration = {0.1, 0.3, 0.5};
  ASSERT_EQ(warnings().size(), 1u);
  EXPECT_THAT(warnings()[0],
              HasSubstr("a contact duration × shear rate of 0.3, your tests at most at 0.004"));
  process = Sheared("drum", true, 5e-3, 20);
  process.bond_number = 30;
  EXPECT_THAT(warnings()[0], HasSubstr("a Bond number of 30, your tests at most at 5"));
}

// One run of 1 mm grains at scale factor 2: their I is twice the powder's, P and γ̇ are the bulk's.
TEST(Regimes, AreOfThePowdersOwnGrains) {
  rigs::Case rig_case;
  rig_case.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 5e-4};
  rig_case.powder.material.surface_energy = 1e-3;
  rig_case.models.adhesion = engine::Adhesion::kDmt;
  rig_case.coarse_graining.scale_factor = 2;
  const rigs::Regime run{
      .inertial_number = {0.01, 0.1, 1}, .pressure = {1, 10, 100}, .shear_rate = {2, 20, 200}};
  const FlowRegime regime = DescribeRegime("heap", {run}, rig_case);
  EXPECT_DOUBLE_EQ(regime.inertial_number[1], 0.05);
  EXPECT_DOUBLE_EQ(regime.pressure[2], 100);
  // πγd over ρπd³g/6.
  const double density = rig_case.powder.material.density;
  EXPECT_NEAR(regime.bond_number, 6 * 1e-3 / (density * 5e-4 * 5e-4 * rig_case.gravity), 1e-9);
  // What two grains state as a pair takes the place of their material's, and was left out.
  rigs::Case of_pairs = rig_case;
  of_pairs.pairs = {{.between = {"powder", "plate"}, .stated = {.surface_energy = 7e-3}},
                    {.between = {"powder", "powder"}, .stated = {.surface_energy = 4e-3}}};
  EXPECT_NEAR(DescribeRegime("heap", {run}, of_pairs).bond_number, 4 * regime.bond_number, 1e-9);
  // JKR pulls off at three quarters of it, and grains without adhesion at nothing.
  rig_case.models.adhesion = engine::Adhesion::kJkr;
  EXPECT_NEAR(DescribeRegime("heap", {run}, rig_case).bond_number, 0.75 * regime.bond_number,
              1e-12);
  rig_case.models.adhesion = engine::Adhesion::kNone;
  EXPECT_EQ(DescribeRegime("heap", {run}, rig_case).bond_number, 0);
  // t_c γ̇ goes with γ̇^(4/5). At 20/s m* is 8.1812e-8 kg, Y* 5.4945e6 Pa, R* 1.25e-4 m and γ̇ d
  // 0.01 m/s: t_c = 1.2813e-4 s.
  EXPECT_NEAR(regime.contact_duration[1], 2.5626e-3, 1e-7);
  EXPECT_NEAR(regime.contact_duration[2] / regime.contact_duration[1], std::pow(10, 0.8), 1e-6);
}

TEST(Regimes, OfTestsAreThoseOfGrainsLikeTheProcesss) {
  EXPECT_EQ(NearestScaleFactor({4, 2, 1}, 1), 1);
  EXPECT_EQ(NearestScaleFactor({4, 2, 1}, 2.7), 2);
  EXPECT_EQ(NearestScaleFactor({4, 2, 1}, 2.9), 4);  // in ratio
  EXPECT_EQ(NearestScaleFactor({6, 4}, 1), 4);
}

TEST(Regimes, AreReadFromAResultAndNoneIsFoundWhereItHasNone) {
  const fs::path folder = fs::path(testing::TempDir()) / "talus_regime";
  fs::create_directories(folder);
  std::ofstream(folder / "result.json") << base::WithChecksum(R"({"regime": {
    "inertial_number": [1, 2, 3], "pressure_Pa": [4, 5, 6], "shear_rate_per_s": [7, 8, 9]}})"
                                                              "\n");
  EXPECT_EQ(RegimeIn(folder)->pressure[1], 5);
  std::ofstream(folder / "result.json") << base::WithChecksum("{}\n");
  EXPECT_FALSE(RegimeIn(folder).has_value());
  EXPECT_FALSE(RegimeIn(folder / "absent").has_value());
}

TEST(Spread, ADrawCountsByItsWeight) {
  const Spread spread({.runs = {{1}, {5}}, .weight = {3, 1}});
  EXPECT_NEAR(spread.mean(), 2, 1e-12);
}

TEST(Spread, TheSurrogatesErrorIsNoShareOfTheParameters) {
  const surrogate::Predictions sets{.mean = Eigen::Vector2d(0, 2),
                                    .variance = Eigen::Vector2d(1, 1)};
  const Spread spread(sets, 0.5);
  const double parameters = spread.parameters_sd() * spread.parameters_sd();
  const double surrogate = kOverconfidence * kOverconfidence;
  EXPECT_NEAR(spread.ParametersShare(), parameters / (parameters + surrogate + 0.25), 1e-12);
}

}  // namespace predicted_numbers_test
}  // namespace talus::analysis
