// Numbers of one test that cannot all be true, and stresses that lack their unit.
#include "experiments/campaign/spec/agreeing_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/units.h"
#include "experiments/campaign/spec/plausible_stresses.h"
#include "experiments/campaign/spec/possible_numbers.h"

namespace talus::campaign {
namespace agreeing_numbers_test {

using rigs::Observable;
using ::testing::AllOf;
using ::testing::HasSubstr;

template <Observable O>
void Give(ExperimentSpec& e, double value, double error) {
  auto& number = e.numbers.Of<O>().emplace();
  number.value = value;
  number.standard_error = error;
}

ExperimentSpec Of(rigs::RigKind kind) {
  ExperimentSpec e;
  e.rig.emplace().kind = kind;
  return e;
}

// Powder of 1540 kg/m³, 1.6 g of it.
std::string Said(const ExperimentSpec& e) {
  base::Problems problems;
  RequireAgreeing(
      e, {.prefix = "", .grain_density = 1540, .filled = 1.6e-3, .filled_by = "powder.mass"},
      problems);
  return problems.Text();
}

std::string SaidOfStresses(const ExperimentSpec& e) {
  base::Problems problems;
  CheckStresses(e, "", problems);
  return problems.Text();
}

ExperimentSpec Cell(std::vector<double> stresses) {
  ExperimentSpec e = Of(rigs::RigKind::kShearCell);
  e.rig->shear_cell.stresses = std::move(stresses);
  return e;
}

// 0.64/0.52 is 1.23 within 0.014.
TEST(AgreeingNumbers, HausnerRatioIsThatOfTheDensities) {
  ExperimentSpec e = Of(rigs::RigKind::kTappedDensity);
  Give<Observable::kTappedDensity>(e, 640, 3.2);
  Give<Observable::kHausnerRatio>(e, 1.5, 0.015);
  EXPECT_EQ(Said(e), "");  // nothing beside it
  Give<Observable::kPouredDensity>(e, 520, 5.2);
  EXPECT_THAT(Said(e), AllOf(HasSubstr("hausner_ratio: is 1.5, but tapped_density over"),
                             HasSubstr("poured_density is 1.23")));
  Give<Observable::kHausnerRatio>(e, 1.26, 0.015);
  EXPECT_EQ(Said(e), "");
}

TEST(AgreeingNumbers, SolidFractionIsThatOfTheDensity) {
  ExperimentSpec e = Of(rigs::RigKind::kTappedDensity);
  Give<Observable::kTappedDensity>(e, 640, 3.2);
  Give<Observable::kTappedSolidFraction>(e, 0.6, 0.01);
  EXPECT_THAT(Said(e), AllOf(HasSubstr("tapped_solid_fraction: is 0.6"), HasSubstr("is 0.4156")));
  base::Problems problems;  // of grains whose density is searched nothing is known
  RequireAgreeing(e, {.prefix = ""}, problems);
  EXPECT_EQ(problems.Text(), "");
  Give<Observable::kTappedSolidFraction>(e, 0.42, 0.005);
  EXPECT_EQ(Said(e), "");
}

TEST(AgreeingNumbers, WhatDoesNotFlowHasNoRateAndNoTime) {
  ExperimentSpec e = Of(rigs::RigKind::kOrificeFlow);
  Give<Observable::kFlows>(e, 0, 0.25);
  Give<Observable::kDischargeRate>(e, 0, 1e-5);
  EXPECT_EQ(Said(e), "");
  Give<Observable::kDischargeRate>(e, 3e-3, 1e-4);
  EXPECT_THAT(Said(e), HasSubstr("flows: is 0, so that an arch stands, beside a discharge_rate"));
  Give<Observable::kDischargeTime>(e, 2, 0.1);
  EXPECT_THAT(Said(e), HasSubstr("beside a discharge_time"));
  Give<Observable::kFlows>(e, 1, 0.25);
  EXPECT_EQ(Said(e), "");
  Give<Observable::kDischargeRate>(e, 0, 1e-4);
  EXPECT_THAT(Said(e), HasSubstr("discharge_rate: is 0 beside flows 1"));
}

TEST(AgreeingNumbers, PartsAreNoMoreThanWhatWasFilledIn) {
  ExperimentSpec e = Of(rigs::RigKind::kLiftedTube);
  Give<Observable::kMassOnPlate>(e, 1.2e-3, 1e-5);
  Give<Observable::kMassFallen>(e, 0.4e-3, 1e-5);
  EXPECT_EQ(Said(e), "");
  Give<Observable::kMassFallen>(e, 0.9e-3, 1e-5);
  EXPECT_THAT(Said(e), HasSubstr("mass_on_plate: and mass_fallen are 2.1 g together, more than the "
                                 "1.6 g filled in (powder.mass)"));
}

TEST(AgreeingNumbers, AHeapEndsBelowAFunnelThatStandsStill) {
  ExperimentSpec e = Of(rigs::RigKind::kFunnelHeap);
  Give<Observable::kHeight>(e, 0.03, 5e-4);
  e.rig->funnel_heap.height = 0.025;
  EXPECT_THAT(Said(e), AllOf(HasSubstr("height: is 0.03, in m, is above the funnel's outlet"),
                             HasSubstr("25 mm over the plate (rig.height)")));
  e.rig->funnel_heap.follows = true;
  EXPECT_EQ(Said(e), "");
}

TEST(AgreeingNumbers, AStressInKilopascalsIsToldByItsNormalStress) {
  ExperimentSpec e = Cell({200, 400});
  Give<Observable::kShearStress1>(e, 190, 10);
  EXPECT_EQ(SaidOfStresses(e), "");
  Give<Observable::kShearStress1>(e, 0.19, 0.01);
  EXPECT_THAT(SaidOfStresses(e),
              AllOf(HasSubstr("shear_stress_1: is 0.19, in Pa, 0.00095 of its normal stress, 200 "
                              "Pa (rig.stresses[0])"),
                    HasSubstr("write \"0.19 kPa\"")));
  Give<Observable::kShearStress1>(e, 190e3, 1e4);
  EXPECT_THAT(SaidOfStresses(e), HasSubstr("950 of its normal stress, 200 Pa"));
}

TEST(AgreeingNumbers, ACohesionInKilopascalsIsToldByItsErrorToo) {
  ExperimentSpec e = Cell({1000, 2000});
  for (const auto& [value, error] : {std::pair{0.0, 50.0}, {1.0, 50.0}, {900.0, 50.0}}) {
    Give<Observable::kCohesion>(e, value, error);
    EXPECT_EQ(SaidOfStresses(e), "") << value;
  }
  Give<Observable::kCohesion>(e, 0.25, 0.05);
  EXPECT_THAT(SaidOfStresses(e), HasSubstr("write \"0.25 kPa\""));
  Give<Observable::kCohesion>(e, 250e3, 1e3);
  EXPECT_THAT(SaidOfStresses(e), HasSubstr("the largest normal stress, 2000 Pa"));
}

TEST(AgreeingNumbers, ShearStressesRiseWithTheNormalStresses) {
  ExperimentSpec e = Cell({1000, 2000, 4000});
  Give<Observable::kShearStress1>(e, 2100, 60);
  Give<Observable::kShearStress3>(e, 600, 20);
  EXPECT_THAT(SaidOfStresses(e),
              HasSubstr("shear_stress_3: is 600, in Pa, is below shear_stress_1, 2100 Pa, while "
                        "the normal stress rises from 1000 Pa to 4000 Pa"));
  Give<Observable::kShearStress3>(e, 2000, 60);
  EXPECT_EQ(SaidOfStresses(e), "");  // within their errors
}

// A line through 600, 1100 and 2100 Pa rises by 0.5, 26.6°.
TEST(AgreeingNumbers, TheAngleOfInternalFrictionIsThatOfTheStresses) {
  ExperimentSpec e = Cell({1000, 2000, 4000});
  Give<Observable::kFrictionAngle>(e, 0.75, 0.02);
  EXPECT_EQ(SaidOfStresses(e), "");
  Give<Observable::kShearStress1>(e, 600, 10);
  EXPECT_EQ(SaidOfStresses(e), "");  // one gives no line
  Give<Observable::kShearStress2>(e, 1100, 10);
  Give<Observable::kShearStress3>(e, 2100, 20);
  EXPECT_THAT(SaidOfStresses(e), AllOf(HasSubstr("internal_friction_angle: is 43 deg"),
                                       HasSubstr("rises by 26.6 deg")));
  Give<Observable::kFrictionAngle>(e, 0.55, 0.02);
  EXPECT_EQ(SaidOfStresses(e), "");
}

TEST(AgreeingNumbers, WhatIsNeverZeroIsKnownBetterThanItsValue) {
  ExperimentSpec e = Of(rigs::RigKind::kTappedDensity);
  const auto said = [&] {
    base::Problems problems;
    RequirePossible(e.numbers, "", problems);
    return problems.Text();
  };
  Give<Observable::kMassFallen>(e, 2e-6, 3e-6);  // may be none
  EXPECT_EQ(said(), "");
  Give<Observable::kTappedDensity>(e, 640, 1000);
  EXPECT_THAT(said(), HasSubstr("tapped_density.sd: is 1000, as a standard error must be below the "
                                "value, 640 kg/m^3"));
}

// A yes is seen once, or n times: an error of none would make it count without end.
TEST(AgreeingNumbers, AYesNTimesIsKnownByTheRootOfTheirNumber) {
  ExperimentSpec e = Of(rigs::RigKind::kOrificeFlow);
  auto& flows = e.numbers.Of<Observable::kFlows>().emplace();
  base::Problems problems;
  flows.values = {1, 1, 1, 1};
  flows.Validate(problems);
  EXPECT_DOUBLE_EQ(flows.StandardError(), 0.125);
  flows.values = {1, 1, 0};
  flows.Validate(problems);
  EXPECT_NEAR(flows.StandardError(), 1.0 / 3, 1e-12);  // sd √(1/3), over √3
  EXPECT_EQ(problems.Text(), "");
  auto& ratio = e.numbers.Of<Observable::kHausnerRatio>().emplace();
  ratio.values = {1.2, 1.2};
  ratio.Validate(problems);
  EXPECT_THAT(problems.Text(), HasSubstr("are all the same"));
}

// The mean of three times 22 degrees is not 22 degrees to the last bit: it passed, as exact.
TEST(AgreeingNumbers, EqualValuesAreAllTheSameWhateverTheirMean) {
  for (const double value : {22 * base::kDegree, 0.7, 1.5e-3, 3e-3}) {
    for (const std::size_t count : {2u, 3u, 5u}) {
      ExperimentSpec e = Of(rigs::RigKind::kTappedDensity);
      auto& ratio = e.numbers.Of<Observable::kHausnerRatio>().emplace();
      ratio.values = std::vector<double>(count, value);
      base::Problems problems;
      ratio.Validate(problems);
      EXPECT_THAT(problems.Text(), HasSubstr("are all the same")) << value << " " << count;
    }
  }
}

// Two readings that agree by luck have a small error, of one degree of freedom: 3.8 times as large.
TEST(AgreeingNumbers, TheErrorOfTwoValuesIsWidenedHereToo) {
  ExperimentSpec e = Of(rigs::RigKind::kTappedDensity);
  e.numbers.Of<Observable::kTappedDensity>().emplace().values = {1480, 1481};
  e.numbers.Of<Observable::kPouredDensity>().emplace().values = {1200, 1201};
  e.numbers.Of<Observable::kHausnerRatio>().emplace().values = {1.270, 1.271};
  EXPECT_EQ(Said(e), "");
}

}  // namespace agreeing_numbers_test
}  // namespace talus::campaign
