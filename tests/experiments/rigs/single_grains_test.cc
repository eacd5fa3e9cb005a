// What decides of single grains: whether they hang on plate or tube, can only fall, land, move.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/run/resisted_spins.h"
#include "experiments/rigs/lifted_tube/connectivity.h"
#include "experiments/rigs/lifted_tube/fallen.h"
#include "experiments/rigs/phased/contact_sets.h"
#include "experiments/rigs/phased/landing.h"
#include "experiments/rigs/phased/rest.h"

namespace talus::rigs {
namespace single_grains_test {

TEST(Connectivity, FollowsContactsToThePlateAndElseToTheTube) {
  std::vector<engine::Particle> grains(6);
  for (int i = 0; i < 6; ++i) grains[static_cast<std::size_t>(i)].id = 10 * i;
  constexpr std::int64_t kOnTube = -1 - kTube;
  constexpr std::int64_t kOnPlate = -1 - kPlate;
  const auto touch = [](std::int64_t first, std::int64_t second) {
    return engine::ContactInfo{
        .first = first, .second = second, .overlap = 1e-6, .normal = {}, .force = {}};
  };
  // 0 on the plate, 10 on 0; 20 on the tube, 30 on 20; 40 in the air; 50 on plate and tube.
  std::vector<engine::ContactInfo> contacts{touch(0, kOnPlate), touch(0, 10), touch(20, kOnTube),
                                            touch(20, 30), touch(50, kOnTube)};
  Connectivity connected = Connect(grains, contacts);
  EXPECT_EQ(connected.on_plate, (std::vector<bool>{true, true, false, false, false, false}));
  EXPECT_EQ(connected.on_tube, (std::vector<bool>{false, false, true, true, false, true}));
  EXPECT_FALSE(connected.tube_touches_heap);
  contacts.push_back(touch(50, kOnPlate));
  connected = Connect(grains, contacts);
  EXPECT_TRUE(connected.on_plate[5]);
  EXPECT_FALSE(connected.on_tube[5]);
  EXPECT_TRUE(connected.tube_touches_heap);
}

// 0 at a wall and 10 at 0; 20 on the floor and at the wall; 30 in the air. What hangs where there
// is no floor is all that reaches the wall.
TEST(ContactSets, WhatHangsReachesAWallAndNoFloor) {
  std::vector<engine::Particle> grains(4);
  for (int i = 0; i < 4; ++i) grains[static_cast<std::size_t>(i)].id = 10 * i;
  constexpr int kSide = 2, kBottom = 3;
  std::vector<engine::ContactInfo> contacts;
  const auto touch = [&](std::int64_t first, std::int64_t second) {
    contacts.push_back(
        {.first = first, .second = second, .overlap = 1e-6, .normal = {}, .force = {}});
  };
  touch(0, -1 - kSide);
  touch(0, 10);
  touch(20, -1 - kSide);
  touch(20, -1 - kBottom);
  const ContactSets sets(grains, contacts);
  EXPECT_EQ(sets.Hanging({kSide}, kBottom), (std::vector<bool>{true, true, false, false}));
  EXPECT_EQ(sets.Hanging({kSide}), (std::vector<bool>{true, true, true, false}));
}

engine::Particle Grain(engine::Vec3 position, engine::Vec3 velocity) {
  static std::int64_t id = 0;
  return {.id = id++,
          .material = 0,
          .radius = 0.5e-3,
          .position = position,
          .velocity = velocity,
          .angular_velocity = {}};
}

// On a plate and in a tube of 10 mm, with a heap that reaches 5.5 mm out and hangs 0.5 mm over.
TEST(CanOnlyFall, NamesWhatNothingCanBringBack) {
  const double fast = -0.15;  // a free fall over the diameter of 1 mm ends at 0.14 m/s
  const std::vector<engine::Particle> grains{
      Grain({5e-3, 0, 0}, {}),                    // of the heap, over the rim
      Grain({0, 0, 4e-3}, {0, 0, fast}),          // falls onto the heap
      Grain({5.6e-3, 0, -0.8e-3}, {}),            // under the rim, beside what hangs there
      Grain({5.6e-3, 0, -1.1e-3}, {}),            // lower than all that hangs
      Grain({5.6e-3, 0, -1.1e-3}, {0, 0, 1}),     // the same, but 1 m/s takes it up by 51 mm
      Grain({5.6e-3, 0, -0.6e-3}, {0, 0, fast}),  // touches the heap, but falls: nothing holds it
      Grain({6.2e-3, 0, 3e-3}, {1e-3, 0, 0}),     // beyond all, moving outwards
      Grain({6.2e-3, 0, 3e-3}, {-1e-3, 0, 0}),    // beyond all, moving back
  };
  Connectivity connected{.on_plate = std::vector<bool>(grains.size()),
                         .on_tube = std::vector<bool>(grains.size())};
  connected.on_plate[0] = connected.on_plate[5] = true;
  const std::int64_t first = grains[0].id;
  EXPECT_EQ(CanOnlyFall(grains, connected, LiftedTubeOptions(), 9.81),
            (std::vector<std::int64_t>{first + 3, first + 5, first + 6}));
}

TEST(EnergyRatio, LeavesTheFastestGrainsOutAndCountsSpin) {
  EnergyRatio energy(9.81);
  const double fall = std::sqrt(2 * 9.81 * 1e-3);  // over a diameter: an energy of m g d
  for (int k = 0; k < 399; ++k) energy.Add(Grain({}, {}), {}, {});
  energy.Add(Grain({}, {}), {fall, 0, 0}, {});
  EXPECT_NEAR(energy.Value(), 1.0 / 400, 1e-12);
  EXPECT_EQ(energy.ValueWithoutFastest(0.005), 0);  // two grains of 400
  // A single grain that falls is not at rest, nor is the boulder among fines.
  EnergyRatio single(9.81);
  single.Add(Grain({}, {}), {fall, 0, 0}, {});
  EXPECT_NEAR(single.ValueWithoutFastest(0.005), 1, 1e-12);
  EnergyRatio rolling(9.81);
  rolling.Add(Grain({}, {}), {fall, 0, 0}, {0, fall / 0.5e-3, 0});
  EXPECT_NEAR(rolling.Value(), 1.4, 1e-12);
}

TEST(ResistedSpins, LeaveOutTheTwistOfASingleContact) {
  std::vector<engine::Particle> grains;
  for (int k = 0; k < 3; ++k) grains.push_back(Grain({}, {}));
  for (engine::Particle& p : grains) p.angular_velocity = {1, 2, 3};
  const auto touch = [&](int i, int j) {
    return engine::ContactInfo{.first = grains[i].id,
                               .second = grains[j].id,
                               .overlap = 1e-6,
                               .normal = {0, 0, 1},
                               .force = {}};
  };
  const std::vector<engine::ContactInfo> contacts{touch(0, 1), touch(1, 2)};
  const std::vector<engine::Vec3> spins = engine::ResistedSpins(grains, contacts);
  EXPECT_EQ(spins[0], (engine::Vec3{1, 2, 0}));
  EXPECT_EQ(spins[1], (engine::Vec3{1, 2, 3}));
  EXPECT_EQ(spins[2], (engine::Vec3{1, 2, 0}));
}

TEST(Landing, WithinADiameterOfTheHeapAGrainBelongsToIt) {
  const double r = 1e-3;
  const auto at = [&](double x, double z) {
    return engine::Particle{.radius = r, .position = {x, 0, z}};
  };
  // On the plate; just above it; two diameters above the plate; above the second, which lands;
  // beside the plate; above the first by more than a diameter.
  const std::vector<engine::Particle> grains{at(0, r),           at(4e-3, 1.5 * r),
                                             at(8e-3, 5.5 * r),  at(4e-3, 3.6 * r),
                                             at(20e-3, 1.2 * r), at(0, 5.1 * r)};
  std::vector<bool> on_heap{true, false, false, false, false, false};
  AddLanding(grains, 10e-3, on_heap);
  EXPECT_EQ(on_heap, (std::vector<bool>{true, true, false, true, false, false}));
}

}  // namespace single_grains_test
}  // namespace talus::rigs
