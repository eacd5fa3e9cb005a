#include "experiments/rigs/column_collapse/column_collapse_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/phased/surface.h"

namespace talus::rigs {
namespace {

constexpr int kGate = 0;
constexpr double kFront = 0.99;  // of the mass lies behind the front

}  // namespace

ColumnCollapseRig::ColumnCollapseRig(const Case& c, State state, engine::Simulation simulation)
    : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
  Phase running = Resting("running out", c.rules.heap);
  running.filmed = true;
  running.begin = [this] { Open(); };
  SetPhases({running}, TestTime(c, FilledHeight(c, vessel())));
}

void ColumnCollapseRig::Open() {
  const auto& velocity = rig_case().rig.column_collapse.gate_velocity;
  if (!velocity) return scene().RemoveWall(kGate);
  scene().SetMotion(kGate, {{.time = scene().time(), .velocity = {0, 0, *velocity}}});
}

std::vector<engine::Wall> ColumnCollapseRig::Walls(const Case& c, double height) {
  const ColumnCollapseOptions& channel = c.rig.column_collapse;
  const engine::Rectangle gate{.center = {channel.length / 2, 0, 0.75 * height},
                               .normal = {1, 0, 0},
                               .edge = {0, 1, 0},
                               .width = channel.width,
                               .height = 1.5 * height};
  return {{.name = "gate", .shape = gate, .material = kWalls},
          {.name = "floor", .shape = engine::Plane{}, .material = kFloor},
          {.name = "end",
           .shape = engine::Plane{.point = {-channel.length / 2, 0, 0}, .normal = {1, 0, 0}},
           .material = kWalls},
          {.name = "front",
           .shape = engine::Plane{.point = {0, -channel.width / 2, 0}, .normal = {0, 1, 0}},
           .material = kWalls},
          {.name = "back",
           .shape = engine::Plane{.point = {0, channel.width / 2, 0}, .normal = {0, -1, 0}},
           .material = kWalls}};
}

Vessel ColumnCollapseRig::VesselOf(const Case& c) {
  const ColumnCollapseOptions& channel = c.rig.column_collapse;
  return BoxVessel({}, channel.length, channel.width);
}

void ColumnCollapseRig::Validate(const Case&, base::Problems&) {}

double ColumnCollapseRig::Width(const Case& c) { return c.rig.column_collapse.length; }

// It falls and runs out in a few times √(h/g).
double ColumnCollapseRig::TestTime(const Case& c, double filled_height) {
  const auto& velocity = c.rig.column_collapse.gate_velocity;
  return 5 * std::sqrt(filled_height / c.gravity) + (velocity ? filled_height / *velocity : 0);
}

std::vector<Reading> ColumnCollapseRig::Readings(GrainSpan grains) const {
  const double length = rig_case().rig.column_collapse.length;
  const double front = MassQuantile(grains, kFront, [](const auto& p) { return p.position.x; });
  double top = 0;
  for (const engine::Particle& p : grains) top = std::max(top, p.position.z + p.radius);
  const double runout = front - length / 2;
  std::vector<Reading> all{{Observable::kRunout, runout},
                           {Observable::kHeight, top},
                           {Observable::kColumnHeight, state().bed.height},
                           {Observable::kAspectRatio, state().bed.height / length}};
  // Between the foot of the end wall and the thin front.
  const double reach = front + length / 2;
  all.push_back(AngleOf(Observable::kAngle, SurfaceOf(grains, {.from = -length / 2 + 0.2 * reach,
                                                               .to = -length / 2 + 0.8 * reach,
                                                               .width = MeanDiameter()})));
  return all;
}

}  // namespace talus::rigs
