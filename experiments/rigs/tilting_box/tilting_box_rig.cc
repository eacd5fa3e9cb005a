#include "experiments/rigs/tilting_box/tilting_box_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace talus::rigs {
namespace {

constexpr int kGate = 0;
constexpr double kSlid = 0.5;  // mean diameters

// In PhasedState::numbers.
enum Number { kStartCentre, kAngle, kMassLeft, kNumNumbers };

double Degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::vector<engine::Wall> Walls(const HeapCase& c, double height) {
  const TiltingBoxOptions& box = c.rig->tilting_box;
  const double lip = box.lip_height.value_or(0);
  const double gate = std::max(1.5 * height, 2 * lip);
  const auto across = [&](double low, double high) {
    return engine::Rectangle{.center = {box.length / 2, 0, (low + high) / 2},
                             .normal = {1, 0, 0},
                             .edge = {0, 1, 0},
                             .width = box.width,
                             .height = high - low};
  };
  const auto side = [](engine::Vec3 point, engine::Vec3 normal) {
    return engine::Plane{.point = point, .normal = normal};
  };
  std::vector<engine::Wall> walls{
      {.name = "gate", .shape = across(lip, gate), .material = kWalls},
      {.name = "floor",
       .shape = engine::Rectangle{.center = {}, .width = box.length, .height = box.width},
       .material = kFloor},
      {.name = "end", .shape = side({-box.length / 2, 0, 0}, {1, 0, 0}), .material = kWalls},
      {.name = "front", .shape = side({0, -box.width / 2, 0}, {0, 1, 0}), .material = kWalls},
      {.name = "back", .shape = side({0, box.width / 2, 0}, {0, -1, 0}), .material = kWalls}};
  if (lip > 0) walls.push_back({.name = "lip", .shape = across(0, lip), .material = kWalls});
  return walls;
}

}  // namespace

TiltingBoxRig::TiltingBoxRig(const HeapCase& c)
    : PhasedRig(c, VesselOf(c), [&c](double height) { return Walls(c, height); }) {
  Plan();
}

TiltingBoxRig::TiltingBoxRig(const HeapCase& c, const PhasedState& state,
                             engine::Simulation simulation)
    : PhasedRig(c, VesselOf(c), state, std::move(simulation)) {
  Plan();
}

void TiltingBoxRig::Plan() {
  const TiltingBoxOptions& box = heap_case().rig->tilting_box;
  memory().numbers.resize(kNumNumbers, 0);
  std::vector<Phase> phases;
  if (box.lip_height) {
    phases.push_back({.name = "opening",
                      .ends_with = PhaseEnd::kAtRest,
                      .rest = heap_case().rules.heap,
                      .begin = [this] { scene().RemoveWall(kGate); }});
  }
  phases.push_back(
      {.name = "tilting", .duration = box.largest_angle / box.rate, .begin = [this] { Tilt(); }});
  SetPhases(std::move(phases));
}

void TiltingBoxRig::Tilt() {
  memory().numbers[kStartCentre] = Centre();
  const double rate = heap_case().rig->tilting_box.rate;
  scene().SetGravityTurns({{.time = scene().time(), .angular_velocity = {0, -rate, 0}}});
}

double TiltingBoxRig::Centre() const {
  const double left = state().numbers[kMassLeft];
  double mass = left;
  double moment = left * heap_case().rig->tilting_box.length / 2;
  for (const engine::Particle& p : simulation().Particles()) {
    const double m = MassOf({&p, 1});
    mass += m;
    moment += m * p.position.x;
  }
  return moment / mass;
}

bool TiltingBoxRig::Look() {
  const TiltingBoxOptions& box = heap_case().rig->tilting_box;
  const double beyond = box.length / 2 + 2 * simulation().LargestRadius();
  memory().num_left += scene().RemoveIf([&](const engine::Particle& p) {
    const bool leaves = p.position.x > beyond;
    if (leaves) memory().numbers[kMassLeft] += MassOf({&p, 1});
    return leaves;
  });
  if (phase_name() != "tilting") return false;
  const bool slid = Centre() - state().numbers[kStartCentre] > kSlid * MeanDiameter();
  if (slid) memory().numbers[kAngle] = box.rate * (simulation().time() - phase_start());
  return slid;
}

Vessel TiltingBoxRig::VesselOf(const HeapCase& c) {
  return BoxVessel({}, c.rig->tilting_box.length, c.rig->tilting_box.width);
}

void TiltingBoxRig::Validate(const HeapCase&, base::Problems&) {}

double TiltingBoxRig::Width(const HeapCase& c) { return c.rig->tilting_box.length; }

// Most powders slide at half of the usual largest angle.
double TiltingBoxRig::TestTime(const HeapCase& c, double) {
  return 0.5 * c.rig->tilting_box.largest_angle / c.rig->tilting_box.rate;
}

std::vector<Observable> TiltingBoxRig::Observables() const {
  const double angle = state().numbers[kAngle];
  const double largest = Degrees(heap_case().rig->tilting_box.largest_angle);
  Observable slid{.name = "angle_deg"};
  if (angle > 0) {
    slid.value = Degrees(angle);
  } else {
    slid.undefined = "nothing slid up to " + std::to_string(std::lround(largest)) + " deg";
  }
  return {slid, {.name = "mass_left_kg", .value = state().numbers[kMassLeft]}};
}

}  // namespace talus::rigs
