#include "experiments/rigs/spreading/spreading_walls.h"

#include <algorithm>
#include <string>

#include "engine/scene/size_distribution.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/pouring.h"

namespace talus::rigs {
namespace {

constexpr double kSpreaderHeight = 3;  // heights of the heap: it piles up before the spreader
constexpr double kGateHeight = 1.5;    // the same
constexpr double kApron = 3;           // heaps' lengths: ground for what is pushed off a bed
// A bed is filled higher than its level, as it sinks when it settles.
constexpr double kBedSinks = 0.15;  // of its depth
constexpr double kBedSolid = 0.55;  // solid fraction that it is filled with

double WeirHeight(const Case& c) {
  return 2 * kBedSinks * c.rig.spreading.bed.value_or(0) + 4 * LargestDiameter(c);
}

// Upright across the strip.
struct Upright {
  double x = 0;     // [m]
  double low = 0;   // [m]
  double high = 0;  // [m]
};

engine::Rectangle Across(const Upright& at, double width) {
  return {.center = {at.x, 0, (at.low + at.high) / 2},
          .normal = {1, 0, 0},
          .edge = {0, 1, 0},
          .width = width,
          .height = at.high - at.low};
}

engine::Rectangle Level(double from, double to, double height, double width) {
  return {.center = {(from + to) / 2, 0, height}, .width = to - from, .height = width};
}

engine::Wall Roller(const Case& c) {
  const SpreadingOptions& o = c.rig.spreading;
  const double radius = o.RollerRadius();
  const engine::SolidCylinder shape{
      .base = {-o.feed - BehindHeap(c), -o.width / 2, SpreadingGap(c) + radius},
      .axis = {0, 1, 0},
      .radius = radius,
      .length = o.width};
  return {.name = "roller", .shape = shape, .material = kWalls};
}

// A blade whose lower part has slots: half a slot at either side wall.
void AddComb(const Case& c, double top, std::vector<engine::Wall>& walls) {
  const SpreadingOptions& o = c.rig.spreading;
  const double gap = SpreadingGap(c);
  const double x = -o.feed - BehindHeap(c);
  const double root = gap + o.tooth_length.value_or(gap);
  walls.push_back({.name = "comb",
                   .shape = Across({.x = x, .low = root, .high = root + top}, o.width),
                   .material = kWalls});
  const int teeth = NumSpreaderWalls(c) - 1;
  for (int i = 0; i < teeth; ++i) {
    engine::Rectangle tooth = Across({.x = x, .low = gap, .high = root}, o.Pitch() - o.Slot());
    tooth.center.y = -o.width / 2 + (i + 0.5) * o.Pitch();
    walls.push_back({.name = "tooth " + std::to_string(i + 1), .shape = tooth, .material = kWalls});
  }
}

// Around a bed of powder; the weir holds what stands above its level until it is struck off.
void AddTrench(const Case& c, double depth, std::vector<engine::Wall>& walls) {
  const SpreadingOptions& o = c.rig.spreading;
  const auto add = [&](const char* name, const engine::Rectangle& shape) {
    walls.push_back({.name = name, .shape = shape, .material = kFloor});
  };
  add("end", Across({.x = o.length, .low = -depth, .high = 0}, o.width));
  add("weir", Across({.x = o.length, .low = 0, .high = WeirHeight(c)}, o.width));
  add("apron", Level(o.length, o.length + kApron * o.feed, 0, o.width));
}

}  // namespace

double PlatformHeight(const Case& c) {
  return c.rig.spreading.spreader == Spreader::kRoller ? 0 : SpreadingGap(c);
}

double BehindHeap(const Case& c) {
  switch (c.rig.spreading.spreader) {
    case Spreader::kBlade:
      return 0;
    case Spreader::kRoller:
      return c.rig.spreading.RollerRadius();
    case Spreader::kComb:
      return LargestDiameter(c);
  }
  return 0;
}

int NumSpreaderWalls(const Case& c) {
  const SpreadingOptions& o = c.rig.spreading;
  return o.spreader == Spreader::kComb ? 1 + o.teeth.value_or(SpreadingOptions::kTeeth) : 1;
}

std::vector<engine::Wall> SpreadingWalls(const Case& c, double height) {
  const SpreadingOptions& o = c.rig.spreading;
  const double gap = SpreadingGap(c);
  const double ground = PlatformHeight(c);
  const auto side = [](double y, double normal) {
    return engine::Plane{.point = {0, y, 0}, .normal = {0, normal, 0}};
  };
  // What is poured appears higher than the heap will be.
  const double least = height + Headroom(c, SpreadingVessel(c), {});
  const double gate_height = std::max(kGateHeight * height, least);
  const double held = o.bed ? std::max(gate_height, WeirHeight(c)) : gate_height;
  const auto gate = [&](double x) {
    return Across({.x = x, .low = ground, .high = ground + held}, o.width);
  };
  std::vector<engine::Wall> walls;
  const double top = std::max(kSpreaderHeight * height, least);
  if (o.spreader == Spreader::kBlade) {
    walls.push_back({.name = "blade",
                     .shape = Across({.x = -o.feed, .low = gap, .high = gap + top}, o.width),
                     .material = kWalls});
  } else if (o.spreader == Spreader::kRoller) {
    walls.push_back(Roller(c));
  } else {
    AddComb(c, top, walls);
  }
  const double floor = -o.bed.value_or(0);
  walls.push_back({.name = "gate", .shape = gate(0), .material = kWalls});
  walls.push_back(
      {.name = "plate", .shape = engine::Plane{.point = {0, 0, floor}}, .material = kFloor});
  if (ground > floor) {
    const double back = o.spreader == Spreader::kRoller ? 2 * BehindHeap(c) : BehindHeap(c);
    walls.push_back({.name = "platform",
                     .shape = Level(-o.feed - back, 0, ground, o.width),
                     .material = kFloor});
    walls.push_back({.name = "step",
                     .shape = Across({.x = 0, .low = floor, .high = ground}, o.width),
                     .material = kFloor});
  }
  walls.push_back({.name = "front", .shape = side(-o.width / 2, 1), .material = kWalls});
  walls.push_back({.name = "back", .shape = side(o.width / 2, -1), .material = kWalls});
  if (o.spreader != Spreader::kBlade) {
    walls.push_back({.name = "rear gate", .shape = gate(-o.feed), .material = kWalls});
  }
  if (o.bed) AddTrench(c, *o.bed, walls);
  return walls;
}

Vessel SpreadingVessel(const Case& c) {
  const SpreadingOptions& o = c.rig.spreading;
  Vessel vessel = BoxVessel({-o.feed / 2, 0, PlatformHeight(c)}, o.feed, o.width);
  if (!o.bed) return vessel;
  const Vessel trench = BoxVessel({o.length / 2, 0, -*o.bed}, o.length, o.width);
  const double depth = (1 + kBedSinks) * *o.bed + LargestDiameter(c);
  vessel.bed = {.region = trench.region,
                .mass = kBedSolid * c.powder.material.density * trench.area * depth};
  return vessel;
}

}  // namespace talus::rigs
