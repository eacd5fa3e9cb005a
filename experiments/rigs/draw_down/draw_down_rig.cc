#include "experiments/rigs/draw_down/draw_down_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/rigs/phased/surface.h"

namespace talus::rigs {
namespace {

constexpr int kGate = 0;

std::vector<engine::Wall> Walls(const HeapCase& c, double) {
  const DrawDownOptions& box = c.rig->draw_down;
  const double shelf = (box.length - box.slot) / 2;
  const auto level = [&](double x, double width) {
    return engine::Rectangle{.center = {x, 0, box.height}, .width = width, .height = box.width};
  };
  const auto side = [](engine::Vec3 point, engine::Vec3 normal) {
    return engine::Plane{.point = point, .normal = normal};
  };
  return {
      {.name = "gate", .shape = level(0, box.slot), .material = kFloor},
      {.name = "left shelf", .shape = level(-(box.slot + shelf) / 2, shelf), .material = kFloor},
      {.name = "right shelf", .shape = level((box.slot + shelf) / 2, shelf), .material = kFloor},
      {.name = "floor", .shape = engine::Plane{}, .material = kFloor},
      {.name = "left", .shape = side({-box.length / 2, 0, 0}, {1, 0, 0}), .material = kWalls},
      {.name = "right", .shape = side({box.length / 2, 0, 0}, {-1, 0, 0}), .material = kWalls},
      {.name = "front", .shape = side({0, -box.width / 2, 0}, {0, 1, 0}), .material = kWalls},
      {.name = "back", .shape = side({0, box.width / 2, 0}, {0, -1, 0}), .material = kWalls}};
}

struct Flow {
  double time = 0;    // since the slot was opened [s]
  double passed = 0;  // [kg]
};

// When so much had passed [s]; between two looks it is interpolated.
double TimeOf(double passed, const std::vector<Flow>& flow) {
  Flow before;
  for (const Flow& now : flow) {
    if (now.passed >= passed) {
      const double share = (passed - before.passed) / std::max(now.passed - before.passed, 1e-300);
      return before.time + share * (now.time - before.time);
    }
    before = now;
  }
  return flow.back().time;
}

}  // namespace

DrawDownRig::DrawDownRig(const HeapCase& c)
    : PhasedRig(c, VesselOf(c), [&c](double height) { return Walls(c, height); }) {
  Plan();
}

DrawDownRig::DrawDownRig(const HeapCase& c, const PhasedState& state, engine::Simulation simulation)
    : PhasedRig(c, VesselOf(c), state, std::move(simulation)) {
  Plan();
}

void DrawDownRig::Plan() {
  SetPhases({{.name = "discharging",
              .ends_with = PhaseEnd::kAtRest,
              .rest = heap_case().rules.heap,
              .begin = [this] { scene().RemoveWall(kGate); }}});
}

double DrawDownRig::Passed() const {
  const double height = heap_case().rig->draw_down.height;
  double mass = 0;
  for (const engine::Particle& p : simulation().Particles()) {
    if (p.position.z < height) mass += MassOf({&p, 1});
  }
  return mass;
}

// The series holds times and masses by turns.
bool DrawDownRig::Look() {
  if (phase_name() != "discharging") return false;
  memory().series.push_back(simulation().time() - phase_start());
  memory().series.push_back(Passed());
  return false;
}

Vessel DrawDownRig::VesselOf(const HeapCase& c) {
  const DrawDownOptions& box = c.rig->draw_down;
  return BoxVessel({0, 0, box.height}, box.length, box.width);
}

void DrawDownRig::Validate(const HeapCase& c, base::Problems& problems) {
  const double largest =
      c.coarse_graining.scale_factor * engine::SizeCurve(c.powder.sizes).largest();
  problems.Require(c.rig->draw_down.slot > 2 * largest, "rig.slot", c.rig->draw_down.slot,
                   "must be above two (scaled) grain diameters, or nothing runs through it");
}

double DrawDownRig::Width(const HeapCase& c) { return c.rig->draw_down.length; }

// As Beverloo's law has it for a slot, 1.03 ρ_b √g W (D - 1.4 d)^1.5, ten diameters wide.
double DrawDownRig::TestTime(const HeapCase& c, double filled_height) {
  const DrawDownOptions& box = c.rig->draw_down;
  const double rate = std::sqrt(c.gravity) * std::pow(0.8 * box.slot, 1.5);  // of area [m²/s]
  return filled_height * box.length / rate;
}

std::vector<Observable> DrawDownRig::Observables() const {
  const DrawDownOptions& box = heap_case().rig->draw_down;
  std::vector<Flow> flow;
  for (std::size_t i = 0; i + 1 < state().series.size(); i += 2) {
    flow.push_back({.time = state().series[i], .passed = state().series[i + 1]});
  }
  const double passed = Passed();
  std::vector<Observable> all{{.name = "mass_fallen_kg", .value = passed},
                              {.name = "mass_left_kg", .value = FilledMass() - passed}};
  Observable time{.name = "discharge_time_s"};
  Observable rate{.name = "discharge_rate_kg_per_s"};
  if (passed > 0 && !flow.empty()) {
    time.value = TimeOf(0.95 * passed, flow);
    rate.value = 0.4 * passed / (TimeOf(0.6 * passed, flow) - TimeOf(0.2 * passed, flow));
  } else {
    time.undefined = rate.undefined = "nothing ran through the slot";
  }
  all.push_back(time);
  all.push_back(rate);
  // Both halves are one, seen at |x|.
  std::vector<engine::Particle> above, below;
  for (engine::Particle p : simulation().Particles()) {
    p.position.x = std::abs(p.position.x);
    (p.position.z < box.height ? below : above).push_back(p);
  }
  const double foot = MassQuantile(below, 0.98, [](const auto& p) { return p.position.x; });
  all.push_back(
      AngleOf("angle_deg",
              SurfaceOf(below, {.from = 0.2 * foot, .to = 0.8 * foot, .width = MeanDiameter()})));
  all.push_back(AngleOf(
      "shear_angle_deg",
      SurfaceOf(above, {.from = box.slot / 2, .to = box.length / 2, .width = MeanDiameter()})));
  return all;
}

}  // namespace talus::rigs
