#include "experiments/rigs/tilting_box/tilting_box_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "experiments/rigs/case/materials.h"

namespace talus::rigs {
namespace {

constexpr int kGate = 0;
constexpr double kSlid = 0.5;  // mean diameters

double Degrees(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace

TiltingBoxRig::TiltingBoxRig(const Case& c, State state, engine::Simulation simulation)
    : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
  const TiltingBoxOptions& box = rig_case().rig.tilting_box;
  std::vector<Phase> phases;
  if (box.lip_height) {
    phases.push_back(Resting("opening", c.rules.heap));
    phases.back().begin = [this] { scene().RemoveWall(kGate); };
  }
  phases.push_back(Lasting("tilting", box.largest_angle / box.rate));
  phases.back().filmed = true;
  phases.back().begin = [this] { Tilt(); };
  SetPhases(std::move(phases), TestTime(c, FilledHeight(c, vessel())));
}

void TiltingBoxRig::Tilt() {
  memory().start_centre = Centre();
  const double rate = rig_case().rig.tilting_box.rate;
  scene().SetGravityTurns({{.time = scene().time(), .angular_velocity = {0, -rate, 0}}});
}

double TiltingBoxRig::Centre() const {
  const double left = memory().mass_left;
  double mass = left;
  double moment = left * rig_case().rig.tilting_box.length / 2;
  for (const engine::Particle& p : view().particles) {
    const double m = MassOf({&p, 1});
    mass += m;
    moment += m * p.position.x;
  }
  return moment / mass;
}

std::optional<PhaseEnd> TiltingBoxRig::Look() {
  const TiltingBoxOptions& box = rig_case().rig.tilting_box;
  const double beyond = box.length / 2 + 2 * simulation().LargestRadius();
  WeighOut([&](const engine::Particle& p) { return p.position.x > beyond; }, memory().mass_left);
  if (phase_name() != "tilting") return std::nullopt;
  const bool slid = Centre() - memory().start_centre > kSlid * MeanDiameter();
  if (!slid) return std::nullopt;
  memory().angle = box.rate * (simulation().time() - phase_start());
  return PhaseEnd::kDone;
}

std::vector<engine::Wall> TiltingBoxRig::Walls(const Case& c, double height) {
  const TiltingBoxOptions& box = c.rig.tilting_box;
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

Vessel TiltingBoxRig::VesselOf(const Case& c) {
  return BoxVessel({}, c.rig.tilting_box.length, c.rig.tilting_box.width);
}

void TiltingBoxRig::Validate(const Case&, base::Problems&) {}

double TiltingBoxRig::Width(const Case& c) { return c.rig.tilting_box.length; }

// Most powders slide at half of the usual largest angle.
double TiltingBoxRig::TestTime(const Case& c, double) {
  return 0.5 * c.rig.tilting_box.largest_angle / c.rig.tilting_box.rate;
}

std::vector<Reading> TiltingBoxRig::Readings(GrainSpan) const {
  const double angle = memory().angle;
  const double largest = Degrees(rig_case().rig.tilting_box.largest_angle);
  Reading slid{Observable::kAngle};
  if (angle > 0) {
    slid.value = Degrees(angle);
  } else {
    slid.undefined = "nothing slid up to " + std::to_string(std::lround(largest)) + " deg";
  }
  return {slid, {Observable::kMassLeft, memory().mass_left}};
}

}  // namespace talus::rigs
