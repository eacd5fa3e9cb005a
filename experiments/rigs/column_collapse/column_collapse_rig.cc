#include "experiments/rigs/column_collapse/column_collapse_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/rigs/phased/surface.h"

namespace talus::rigs {
namespace {

constexpr int kGate = 0;
constexpr double kFront = 0.99;  // of the mass lies behind the front

std::vector<engine::Wall> Walls(const HeapCase& c, double height) {
  const ColumnCollapseOptions& channel = c.rig->column_collapse;
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

}  // namespace

ColumnCollapseRig::ColumnCollapseRig(const HeapCase& c)
    : PhasedRig(c, VesselOf(c), [&c](double height) { return Walls(c, height); }) {
  Plan();
}

ColumnCollapseRig::ColumnCollapseRig(const HeapCase& c, const PhasedState& state,
                                     engine::Simulation simulation)
    : PhasedRig(c, VesselOf(c), state, std::move(simulation)) {
  Plan();
}

void ColumnCollapseRig::Plan() {
  SetPhases({{.name = "running out",
              .ends_with = PhaseEnd::kAtRest,
              .rest = heap_case().rules.heap,
              .begin = [this] { Open(); }}});
}

void ColumnCollapseRig::Open() {
  const auto& velocity = heap_case().rig->column_collapse.gate_velocity;
  if (!velocity) return scene().RemoveWall(kGate);
  scene().SetMotion(kGate, {{.time = scene().time(), .velocity = {0, 0, *velocity}}});
}

Vessel ColumnCollapseRig::VesselOf(const HeapCase& c) {
  const ColumnCollapseOptions& channel = c.rig->column_collapse;
  return BoxVessel({}, channel.length, channel.width);
}

void ColumnCollapseRig::Validate(const HeapCase&, base::Problems&) {}

double ColumnCollapseRig::Width(const HeapCase& c) { return c.rig->column_collapse.length; }

// It falls and runs out in a few times √(h/g).
double ColumnCollapseRig::TestTime(const HeapCase& c, double filled_height) {
  const auto& velocity = c.rig->column_collapse.gate_velocity;
  return 5 * std::sqrt(filled_height / c.gravity) + (velocity ? filled_height / *velocity : 0);
}

std::vector<Observable> ColumnCollapseRig::Observables() const {
  const double length = heap_case().rig->column_collapse.length;
  const std::vector<engine::Particle> grains = simulation().Particles();
  const double front = MassQuantile(grains, kFront, [](const auto& p) { return p.position.x; });
  double top = 0;
  for (const engine::Particle& p : grains) top = std::max(top, p.position.z + p.radius);
  const double runout = front - length / 2;
  std::vector<Observable> all{{.name = "runout_m", .value = runout},
                              {.name = "height_m", .value = top},
                              {.name = "column_height_m", .value = state().bed.height},
                              {.name = "aspect_ratio", .value = state().bed.height / length}};
  // Between the foot of the end wall and the thin front.
  const double reach = front + length / 2;
  all.push_back(AngleOf("angle_deg", SurfaceOf(grains, {.from = -length / 2 + 0.2 * reach,
                                                        .to = -length / 2 + 0.8 * reach,
                                                        .width = MeanDiameter()})));
  return all;
}

}  // namespace talus::rigs
