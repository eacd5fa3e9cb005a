// The shear cell against what is known of sheared powders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "base/json/json_reader.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_list.h"
#include "experiments/rigs/shear_cell/squeeze.h"
#include "experiments/rigs/shear_cell/yield_line.h"
#include "tests/experiments/rigs/rig_case.h"

namespace talus::rigs {
namespace shear_cell_test {

using ::testing::HasSubstr;

// Grains of 0.7 to 1.3 mm, which do not order into layers, in a cell fourteen of them across. Twice
// the usual speed: half the steps, at an inertial number of 0.005 and less.
Case Cell(double sliding, double surface_energy = 0) {
  Case c;
  c.powder.material = {.density = 2500,
                       .youngs_modulus = 5e6,
                       .restitution = 0.5,
                       .sliding_friction = sliding,
                       .rolling_friction = 0.1,
                       .surface_energy = surface_energy};
  if (surface_energy > 0) c.models.adhesion = engine::Adhesion::kDmt;
  c.powder.sizes = {.kind = engine::SizeKind::kUniform, .min = 0.7e-3, .max = 1.3e-3};
  c.powder.mass = 2.2e-3;
  c.rig.kind = RigKind::kShearCell;
  c.rig.shear_cell.diameter = 0.014;
  c.rig.shear_cell.travel = 0.012;
  c.rig.shear_cell.speed = 0.04;
  return c;
}

nlohmann::json ResultOf(const Rig& rig) {
  return nlohmann::json::parse(rig.ResultText(rig.Grains(), {}));
}

double Value(const nlohmann::json& result, const std::string& name) {
  EXPECT_TRUE(result["observables"].contains(name)) << result.dump(2);
  return result["observables"].value(name, std::nan(""));
}

// The cell of most tests, sheared once for all of them.
const Rig& PlainCell() {
  static const std::unique_ptr<Rig> kRig = Ran(Cell(0.5));
  return *kRig;
}

// Before any look, as where the travel is over between two: "the rig has no such stress" was said.
TEST(ShearCell, ATravelThatIsNotLookedAtHasNoStress) {
  const nlohmann::json result = ResultOf(*MakeRig(Cell(0.5)));
  EXPECT_TRUE(result["observables"].empty());
  for (const char* name : {"shear_stress_1_pa", "shear_stress_2_pa", "cohesion_pa"}) {
    EXPECT_THAT(result["undefined"].value(name, ""),
                HasSubstr("no look fell into the second half"));
  }
}

// Its line goes through the origin but for the weight of the powder, which adds up to 150 Pa, that
// of the whole bed, to the lid's stress (70 Pa of shear), and for the means' scatter of some 30 Pa.
TEST(ShearCell, APowderWithoutCohesionHasALineThroughTheOrigin) {
  const Rig& rig = PlainCell();
  const auto result = ResultOf(rig);
  EXPECT_LT(std::abs(Value(result, "cohesion_pa")), 100);
  std::vector<double> stresses;
  for (const char* name : {"shear_stress_1_pa", "shear_stress_2_pa", "shear_stress_3_pa"}) {
    stresses.push_back(Value(result, name));
  }
  // Spheres with μ = 0.5 that roll: tan φ of 0.35 to 0.55 is published.
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(stresses[i], 0.35 * 1e3 * (1 << i));
    EXPECT_LT(stresses[i], 0.55 * 1e3 * (1 << i));
  }
  EXPECT_NEAR(std::tan(Value(result, "internal_friction_angle_deg") * std::numbers::pi / 180),
              (stresses[2] - stresses[0]) / 3e3, 0.02);
  // The lid carries its stress, and no grain has passed it or its vanes' floor.
  const engine::Simulation& scene = rig.simulation();
  double force = 0;
  const auto loads = scene.WallLoads();
  for (int wall = 2; wall < 15; ++wall) force += loads[wall].force.z;
  EXPECT_NEAR(force / scene.Presses()[0].force, 1, 0.1);
  const double lid = std::get<engine::Disc>(scene.Walls()[2].shape).center.z;
  double overlap = 0;
  int contacts = 0;
  for (const engine::Particle& p : scene.Particles()) {
    EXPECT_GT(p.position.z, 0);
    EXPECT_LT(p.position.z, lid);
  }
  for (const engine::ContactInfo& contact : scene.Contacts()) {
    if (contact.second < 0) continue;
    overlap += contact.overlap / 0.5e-3;
    ++contacts;
  }
  // What validation expects of the squeeze: the estimate is that of the mean grain's mean force.
  EXPECT_NEAR(overlap / contacts / SqueezeShare(Cell(0.5), 4e3), 1, 0.5);
}

// A side of which the modulus alone is stated was as rough as the powder: 1.8 times the stress.
TEST(ShearCell, TheSideIsSmoothUnlessItsFrictionIsStated) {
  Case cell = Cell(0.5);
  cell.rig.shear_cell.stresses = {1e3};
  cell.materials.walls = WallMaterial{.youngs_modulus = 5e6};
  EXPECT_NEAR(Value(ResultOf(*Ran(cell)), "shear_stress_1_pa") /
                  Value(ResultOf(PlainCell()), "shear_stress_1_pa"),
              1, 0.2);
}

TEST(ShearCell, TheAngleGrowsWithFriction) {
  Case smooth = Cell(0.1);
  smooth.rig.shear_cell.stresses = {1e3, 4e3};
  EXPECT_GT(Value(ResultOf(PlainCell()), "internal_friction_angle_deg"),
            Value(ResultOf(*Ran(smooth)), "internal_friction_angle_deg") + 4);
}

// A pull-off of 2πγR in each contact is a stress of φ Z F/(π d²) after Rumpf, 1300 Pa, and tan φ of
// it is cohesion: some 550 Pa.
TEST(ShearCell, CohesionGrowsWithSurfaceEnergy) {
  Case cell = Cell(0.5, 0.5);
  cell.rig.shear_cell.stresses = {1e3, 4e3};
  cell.rig.shear_cell.speed = 0.02;  // twice that would cost a third of the cohesion
  const auto sticky = ResultOf(*Ran(cell));
  EXPECT_GT(Value(sticky, "cohesion_pa"), 200);
  EXPECT_LT(Value(sticky, "cohesion_pa"), 1100);
}

TEST(ShearCell, APouredOneGoesOnFromACheckpointWithTheSameBits) {
  Case c = Cell(0.5);
  c.filling.kind = FillingKind::kPour;
  c.rig.shear_cell.stresses = {1e3};
  c.rig.shear_cell.travel = 0.005;
  base::Problems problems;
  ValidateCase(c, problems);
  EXPECT_TRUE(problems.empty());
  auto whole = MakeRig(c);
  while (whole->phase_name() != "shearing 1") ASSERT_TRUE(whole->Advance());
  const double middle =
      whole->simulation().time() + 0.5 * c.rig.shear_cell.travel.value() / c.rig.shear_cell.speed;
  while (whole->simulation().time() < middle) ASSERT_TRUE(whole->Advance());
  ASSERT_EQ(whole->phase_name(), "shearing 1");
  auto second = RestoreRig(c, whole->StateLine(),
                           engine::Simulation::Restore(whole->simulation().Checkpoint()));
  for (Rig* rig : {whole.get(), second.get()}) {
    while (rig->Advance()) {
    }
  }
  EXPECT_EQ(ResultOf(*second)["observables"], ResultOf(*whole)["observables"]);
  EXPECT_EQ(second->simulation().step(), whole->simulation().step());
  // One stress gives no line.
  EXPECT_THAT(std::string(ResultOf(*whole)["undefined"]["cohesion_pa"]), HasSubstr("no line"));
}

std::string ErrorOf(const std::string& rig, const std::string& modulus = "10 MPa") {
  const std::string text = R"({"powder": {"sizes": {"kind": "mono", "diameter": "1 mm"},
    "material": {"density": 2500, "youngs_modulus": ")" +
                           modulus + R"("}, "mass": "2.2 g"},
    "rig": {"kind": "shear_cell", "diameter": "14 mm")" +
                           rig + "}}";
  return rigs::ErrorOf(text.c_str());
}

TEST(ShearCell, WhatCannotBeShearedIsRefused) {
  EXPECT_EQ(ErrorOf(""), "");
  EXPECT_THAT(ErrorOf(R"(, "stresses": [])"), HasSubstr("rig.stresses: is empty: a lid without"));
  EXPECT_THAT(ErrorOf(R"(, "stresses": ["1 kPa", 0])"), HasSubstr("must be positive"));
  EXPECT_THAT(ErrorOf(R"(, "stresses": ["2 kPa", "1 kPa"])"), HasSubstr("above the one before"));
  EXPECT_THAT(ErrorOf(R"(, "stresses": [1, 2, 3, 4])"), HasSubstr("must be three at most"));
  EXPECT_THAT(ErrorOf("", "1 MPa"),
              HasSubstr("rig.stresses: is 4000, in Pa, and squashes the grains"));
  EXPECT_THAT(ErrorOf(R"(, "travel": "1 mm")"), HasSubstr("rig.travel"));
  EXPECT_THAT(ErrorOf(R"(, "speed": "2 m/s")"), HasSubstr("rig.speed"));
}

TEST(YieldLine, OfPointsOnALineIsThatLine) {
  const std::vector<StressPoint> points{{1e3, 600}, {2e3, 1100}, {4e3, 2100}};
  const auto line = YieldLineOf(points);
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(line->cohesion, 100, 1e-9);
  EXPECT_NEAR(line->slope, 0.5, 1e-12);
  EXPECT_FALSE(YieldLineOf({points.data(), 1}).has_value());
}

TEST(ShearCell, TheLidPressesWithTheStressThatIsStated) {
  const Case c = Cell(0.5);
  const auto rig = MakeRig(c);
  while (rig->phase_name() != "shearing 1") ASSERT_TRUE(rig->Advance());
  ASSERT_EQ(rig->simulation().Presses().size(), 1u);
  const double area = std::numbers::pi / 4 * std::pow(c.rig.shear_cell.diameter, 2);
  EXPECT_NEAR(rig->simulation().Presses()[0].force, c.rig.shear_cell.stresses[0] * area, 1e-12);
}

}  // namespace shear_cell_test
}  // namespace talus::rigs
