#include "experiments/rigs/drum/drum_rig.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "experiments/rigs/phased/surface.h"

namespace talus::rigs {
namespace {

constexpr double kBoxWidth = 1.2;   // of the box that is filled, in radii
constexpr double kBoxFloor = 0.2;   // its floor above the lowest point, in radii
constexpr double kBoxHeight = 1.6;  // in radii

std::vector<engine::Wall> Walls(const HeapCase& c, double) {
  const DrumOptions& drum = c.rig->drum;
  const double radius = drum.diameter / 2;
  const auto lid = [&](double y) {
    return engine::Disc{.center = {0, y, radius}, .normal = {0, 1, 0}, .radius = radius};
  };
  const engine::OpenCylinder side{.base = {0, -drum.width / 2, radius},
                                  .axis = {0, 1, 0},
                                  .radius = radius,
                                  .length = drum.width};
  return {{.name = "side", .shape = side, .material = kWalls},
          {.name = "front", .shape = lid(-drum.width / 2), .material = kWalls},
          {.name = "back", .shape = lid(drum.width / 2), .material = kWalls}};
}

}  // namespace

DrumRig::DrumRig(const HeapCase& c)
    : PhasedRig(c, VesselOf(c), [&c](double height) { return Walls(c, height); }) {
  Plan();
}

DrumRig::DrumRig(const HeapCase& c, const PhasedState& state, engine::Simulation simulation)
    : PhasedRig(c, VesselOf(c), state, std::move(simulation)) {
  Plan();
}

void DrumRig::Plan() {
  const DrumOptions& drum = heap_case().rig->drum;
  const double turn = 2 * std::numbers::pi / drum.speed;
  SetPhases({{.name = "starting", .duration = drum.start_turns * turn, .begin = [this] { Turn(); }},
             {.name = "turning", .duration = drum.turns * turn}});
}

void DrumRig::Turn() {
  const engine::MotionStep motion{.time = scene().time(),
                                  .angular_velocity = {0, heap_case().rig->drum.speed, 0}};
  for (int wall = 0; wall < 3; ++wall) scene().SetMotion(wall, {motion});
}

// The series holds one angle a look.
bool DrumRig::Look() {
  if (phase_name() != "turning") return false;
  const std::vector<engine::Particle> grains = simulation().Particles();
  const auto along = [](const auto& p) { return p.position.x; };
  const double low = MassQuantile(grains, 0.02, along);
  const double high = MassQuantile(grains, 0.98, along);
  const auto slope = SlopeOf(SurfaceOf(
      grains,
      {.from = low + (high - low) / 4, .to = high - (high - low) / 4, .width = MeanDiameter()}));
  if (slope) memory().series.push_back(SlopeAngle(-*slope));
  return false;
}

Vessel DrumRig::VesselOf(const HeapCase& c) {
  const double radius = c.rig->drum.diameter / 2;
  return BoxVessel({0, 0, kBoxFloor * radius}, kBoxWidth * radius, c.rig->drum.width);
}

void DrumRig::Validate(const HeapCase& c, base::Problems& problems) {
  problems.Require(!c.filling.taps, "filling.taps", "are not of this rig: remove them");
  problems.Require(c.filling.kind == FillingKind::kDense, "filling.kind",
                   "must be \"dense\": a closed drum is not poured into");
  const double most = kBoxHeight * c.rig->drum.diameter / 2;
  const double filled = EstimateHeap(c).filled_height;
  problems.Require(filled < most, "powder.mass", c.powder.mass,
                   "is too much for the drum: it is filled to six tenths at most");
}

double DrumRig::Width(const HeapCase& c) { return c.rig->drum.diameter; }

double DrumRig::TestTime(const HeapCase& c, double) {
  const DrumOptions& drum = c.rig->drum;
  return (drum.start_turns + drum.turns) * 2 * std::numbers::pi / drum.speed;
}

std::vector<Observable> DrumRig::Observables() const {
  const std::vector<double>& angles = state().series;
  Observable angle{.name = "angle_deg"};
  Observable spread{.name = "angle_sd_deg"};
  if (angles.size() < 2) {
    angle.undefined = spread.undefined = "the surface has too few grains across";
    return {angle, spread};
  }
  const auto count = static_cast<double>(angles.size());
  angle.value = std::accumulate(angles.begin(), angles.end(), 0.0) / count;
  double squares = 0;
  for (const double a : angles) squares += (a - angle.value) * (a - angle.value);
  spread.value = std::sqrt(squares / (count - 1));
  return {angle, spread};
}

}  // namespace talus::rigs
