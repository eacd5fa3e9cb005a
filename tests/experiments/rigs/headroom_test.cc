// No grain leaves its vessel over the walls: what is poured falls from the mouth, and taps throw
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "experiments/rigs/filling/pouring.h"
#include "tests/experiments/rigs/rig_case.h"

namespace talus::rigs {
namespace headroom_test {

// A few tenths of a millimetre deep, so that the mouth is far above the powder.
Case Shallow(RigKind kind) {
  Case c = CaseOf(kind, 0.3, 0.1, 0.2e-3);
  c.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 0.7e-3};
  c.powder.material.restitution = 0.9;
  c.filling.kind = FillingKind::kPour;
  return c;
}

double Top(const engine::Wall& wall) {
  if (const auto* tube = std::get_if<engine::OpenCylinder>(&wall.shape)) {
    return tube->base.z + tube->length;
  }
  if (const auto* gate = std::get_if<engine::Rectangle>(&wall.shape)) {
    return gate->center.z + gate->height / 2;
  }
  return 0;
}

// The highest of a vessel that is filled to `height`.
double TopOfWalls(const Case& c, double height) {
  double top = 0;
  for (const engine::Wall& wall : EntryOf(c).walls(c, height)) top = std::max(top, Top(wall));
  return top;
}

TEST(Headroom, PouredGrainsAppearBelowTheTopOfTheWalls) {
  for (const RigKind kind : {RigKind::kTappedDensity, RigKind::kOrificeFlow,
                             RigKind::kColumnCollapse, RigKind::kTiltingBox}) {
    const Case c = Shallow(kind);
    const Vessel vessel = EntryOf(c).vessel(c);
    const double height = PouredHeight(c, vessel);
    EXPECT_GE(TopOfWalls(c, height),
              vessel.region.base.z + height + DropHeight(c, vessel) + MakePour(c, vessel).slab())
        << base::NameOf(kind);
  }
  Case tube = Shallow(RigKind::kLiftedTube);
  tube.filling.drop_height = 0.04;
  EXPECT_GT(TopOfWalls(tube, PouredHeight(tube, EntryOf(tube).vessel(tube))), 0.04);
}

// 20 of 955 grains lay on the plate beyond the gate before the heap was spread. What is placed
// densely has the walls that it had.
TEST(Headroom, AHeapToBeSpreadIsPouredBehindGatesThatHoldIt) {
  for (const Spreader spreader : {Spreader::kBlade, Spreader::kRoller, Spreader::kComb}) {
    Case c = Shallow(RigKind::kSpreading);
    c.rig.spreading = {.spreader = spreader, .length = 0.02, .width = 0.02, .feed = 0.02};
    const Vessel vessel = EntryOf(c).vessel(c);
    const double height = PouredHeight(c, vessel);
    const auto holds = [&](const engine::Wall& wall) {
      return wall.name == "gate" || wall.name == "rear gate" || wall.name == "blade";
    };
    int num_holding = 0;
    for (const engine::Wall& wall : EntryOf(c).walls(c, height)) {
      if (!holds(wall)) continue;
      ++num_holding;
      EXPECT_GE(Top(wall),
                vessel.region.base.z + height + DropHeight(c, vessel) + MakePour(c, vessel).slab())
          << wall.name;
    }
    EXPECT_EQ(num_holding, 2);
    c.filling.kind = FillingKind::kDense;
    for (const engine::Wall& wall : EntryOf(c).walls(c, height)) {
      if (wall.name != "gate") continue;
      EXPECT_DOUBLE_EQ(Top(wall), vessel.region.base.z + 1.5 * height);
    }
  }
}

// Coarse grains need a wider mouth than 0.6 of a narrow tube, and were poured 1.7 times as fast.
TEST(Pouring, CoarseGrainsArePouredAtTheRateOfTrueOnes) {
  Case c = Shallow(RigKind::kLiftedTube);
  c.rig.lifted_tube.tube_inner_diameter = 0.008;
  const auto pour = [&] { return MakePour(c, EntryOf(c).vessel(c)).plan(); };
  const engine::PourPlan fine = pour();
  c.coarse_graining.scale_factor = 2.2;
  const engine::PourPlan coarse = pour();
  EXPECT_GT(coarse.mouth_diameter, 1.2 * fine.mouth_diameter);
  EXPECT_NEAR(coarse.rate, fine.rate, 1e-9 * fine.rate);
}

TEST(Headroom, TappedGrainsHaveRoomForSomeStrokes) {
  Case c = Shallow(RigKind::kTappedDensity);
  c.filling.kind = FillingKind::kDense;
  c.rig.tapped_density.taps.height = 0.014;
  EXPECT_GT(TopOfWalls(c, 0.004), 0.004 + 3 * 0.014);
}

// 7 of 454 grains lay beside the cylinder, and the bed was said to be denser for it.
TEST(Headroom, NoPouredGrainLandsBesideItsCylinder) {
  Case c = Shallow(RigKind::kTappedDensity);
  c.rig.tapped_density = {.diameter = 0.01, .taps = {.count = 1, .height = 1e-3}};
  const auto rig = Ran(c);
  const auto grains = rig->simulation().Particles();
  ASSERT_GT(grains.size(), 400u);
  for (const engine::Particle& p : grains) {
    EXPECT_LT(std::hypot(p.position.x, p.position.y), 0.005);
  }
}

}  // namespace headroom_test
}  // namespace talus::rigs
