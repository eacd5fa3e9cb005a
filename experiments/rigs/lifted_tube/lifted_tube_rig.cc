#include "experiments/rigs/lifted_tube/lifted_tube_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "base/text/counted.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/lifted_tube/expected_heap.h"
#include "experiments/rigs/lifted_tube/fallen.h"
#include "experiments/rigs/phased/landing.h"
#include "experiments/rigs/phased/repose.h"
#include "experiments/rigs/phased/rest.h"
#include "experiments/rigs/phased/spheres.h"

namespace talus::rigs {
namespace {

constexpr double kMuchCarried = 0.01;  // of the powder, left with the tube

using engine::Particle;
using engine::Vec3;

constexpr const char* kLifting = "lifting";
constexpr const char* kResting = "coming to rest";

// Mean kinetic energy relative to the tube, over m g d, below which grains stick to it: falling off
// it they would have that after a fiftieth of a diameter, swinging in their bonds they stay below.
constexpr double kStuckEnergy = 0.02;

double PlateRadius(const engine::Simulation& simulation) {
  const engine::WallShape& plate = simulation.Walls().at(kPlate).shape;
  if (const auto* disc = std::get_if<engine::Disc>(&plate)) return disc->radius;
  return std::get<engine::SolidCylinder>(plate).radius;
}

engine::WallShape PlateOf(const LiftedTubeOptions& options) {
  const double radius = options.plate_diameter / 2;
  if (options.plate == PlateKind::kDisc) return engine::Disc{.center = {}, .radius = radius};
  return engine::SolidCylinder{
      .base = {0, 0, -options.plate_height}, .radius = radius, .length = options.plate_height};
}

}  // namespace

LiftedTubeRig::LiftedTubeRig(const Case& c, State state, engine::Simulation simulation)
    : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)),
      leave_height_(-c.rules.leave_depth * LargestDiameter(c)) {
  const auto lift = [this] {
    const double velocity = rig_case().rig.lifted_tube.lift_velocity;
    scene().SetMotion(kTube, {{.time = scene().time(), .velocity = {0, 0, velocity}}});
  };
  Phase resting = Resting(kResting, c.rules.heap);
  resting.cap_warning = "the heap had not come to rest at rules.heap.max_time";
  SetPhases({{.name = kLifting,
              .ends_with = PhaseEnd::kCleared,
              .criterion = [this] { return Cleared(); },
              .hold_time = c.rules.heap.hold_time,
              .cap = [this] { return LiftMaxTime(); },
              .cap_warning = "the tube had not cleared the heap at its time cap and was taken away",
              .begin = lift,
              .end = [this] { DropTube(); }},
             resting},
            TestTime(c, FilledHeight(c, vessel())));
}

Vessel LiftedTubeRig::VesselOf(const Case& c) {
  const double diameter = c.rig.lifted_tube.tube_inner_diameter;
  return {.region = {.diameter = diameter},
          .area = std::numbers::pi / 4 * std::pow(diameter, 2),
          .across = diameter};
}

// The plate's top is z = 0; the tube stands on it, longer than the powder needs, so that no grain
// hops over its rim: half its diameter, where the mouth is no higher than that.
std::vector<engine::Wall> LiftedTubeRig::Walls(const Case& c, double height) {
  const LiftedTubeOptions& options = c.rig.lifted_tube;
  const bool is_usual =
      c.filling.kind == FillingKind::kPour && !c.filling.drop_height && !c.filling.taps;
  const double spare =
      is_usual ? options.tube_inner_diameter / 2 : Headroom(c, VesselOf(c), c.filling.taps);
  const engine::OpenCylinder tube{.base = {},
                                  .radius = options.tube_inner_diameter / 2,
                                  .length = options.tube_length.value_or(height + spare)};
  return {{.name = "tube", .shape = tube, .material = kWalls, .motion = {}},
          {.name = "plate", .shape = PlateOf(options), .material = kFloor, .motion = {}}};
}

void LiftedTubeRig::Validate(const Case& c, base::Problems& problems) {
  const double filled_height = FilledHeight(c, VesselOf(c));
  const double length = c.rig.lifted_tube.tube_length.value_or(filled_height);
  problems.Require(filled_height <= length, "device.tube_length", length,
                   "cannot hold the mass, which fills " + std::to_string(filled_height) +
                       " m; leave it out or lengthen the tube");
}

// Until the tube has risen above the heap, which forms a little later than the tube lets it, and
// the heap has come to rest.
double LiftedTubeRig::TestTime(const Case& c, double filled_height) {
  const LiftedTubeOptions& options = c.rig.lifted_tube;
  const double late = 2 * std::sqrt(options.tube_inner_diameter / c.gravity);
  const ExpectedHeap heap = ExpectHeap(c);
  return std::min(filled_height, heap.height) / options.lift_velocity + late + heap.rest_time;
}

// Before the tube is lifted nothing can fall.
std::optional<PhaseEnd> LiftedTubeRig::Look() {
  const std::string phase = phase_name();
  if (phase != kLifting && phase != kResting) return std::nullopt;
  connected_ = Connect(view().particles, view().contacts);
  std::vector<std::int64_t> fallen =
      CanOnlyFall(view().particles, connected_, rig_case().rig.lifted_tube, rig_case().gravity);
  for (const Particle& p : view().particles) {
    if (p.position.z + p.radius < leave_height_) fallen.push_back(p.id);
  }
  std::sort(fallen.begin(), fallen.end());
  if (!fallen.empty()) {
    memory().num_fallen += WeighOut(fallen, memory().mass_fallen);
    connected_ = Connect(view().particles, view().contacts);
  }
  if (phase == kResting && view().particles.empty()) return PhaseEnd::kEmpty;
  return std::nullopt;
}

// The lifting ends when the tube's edge is above the heap, the tube does not touch the heap, and
// what sticks to the tube, if anything, moves with it.
bool LiftedTubeRig::Cleared() {
  double top = 0;
  EnergyRatio stuck(rig_case().gravity);
  const Vec3 lifting{0, 0, rig_case().rig.lifted_tube.lift_velocity};
  for (std::size_t i = 0; i < view().particles.size(); ++i) {
    const Particle& p = view().particles[i];
    if (connected_.on_plate[i]) top = std::max(top, p.position.z + p.radius);
    if (connected_.on_tube[i]) stuck.Add(p, p.velocity - lifting, {});
  }
  record().energy_ratio = stuck.Value();
  return TubeEdge() > top && !connected_.tube_touches_heap && stuck.Value() < kStuckEnergy;
}

void LiftedTubeRig::DropTube() {
  std::vector<std::int64_t> carried;
  for (std::size_t i = 0; i < view().particles.size(); ++i) {
    if (connected_.on_tube[i]) carried.push_back(view().particles[i].id);
  }
  scene().RemoveWall(kTube);
  memory().num_carried += WeighOut(carried, memory().mass_carried);
}

double LiftedTubeRig::LiftMaxTime() const {
  const double filled = pours() ? state().bed.height : state().filled_height;
  return rig_case().rules.lift_max_time.value_or(2 * filled /
                                                 rig_case().rig.lifted_tube.lift_velocity);
}

double LiftedTubeRig::TubeEdge() const {
  return (simulation().time() - phase_start()) * rig_case().rig.lifted_tube.lift_velocity;
}

std::vector<Particle> GrainsOfHeap(const engine::Simulation& simulation) {
  return HeapOn(simulation, kPlate, PlateRadius(simulation));
}

std::vector<Particle> LiftedTubeRig::Grains() const { return GrainsOfHeap(simulation()); }

std::vector<Reading> LiftedTubeRig::Readings(GrainSpan heap) const {
  const double density = rig_case().powder.material.density;
  const std::vector<Particle> present = simulation().Particles();
  const double on_plate = MassOf(heap);
  const double falling = MassOf(present) - on_plate;  // what is neither of the heap nor gone
  const auto num_falling = static_cast<double>(present.size() - heap.size());
  const double true_grains = std::pow(rig_case().coarse_graining.scale_factor, 3);  // in one
  std::vector<Reading> all{{Observable::kMassOnPlate, on_plate},
                           {Observable::kMassFallen, memory().mass_fallen + falling},
                           {Observable::kNumFallen,
                            true_grains * (static_cast<double>(memory().num_fallen) + num_falling)},
                           {Observable::kHeight, TopOf(heap)},
                           {Observable::kBulkDensity, density * state().bed.solid_fraction}};
  for (Reading& angle : ReposeReadings(heap, {.diameter = rig_case().rig.lifted_tube.plate_diameter,
                                             .grain_diameter = MeanDiameter()})) {
    all.push_back(std::move(angle));
  }
  return all;
}

std::vector<std::pair<const char*, std::int64_t>> LiftedTubeRig::Counts(GrainSpan heap) const {
  const auto on_heap = static_cast<std::int64_t>(heap.size());
  return {{"filled", state().num_filled},
          {"on_heap", on_heap},
          {"fallen", memory().num_fallen},
          {"carried_by_tube", memory().num_carried},
          {"in_flight", simulation().num_particles() - on_heap}};
}

Rig::Numbers LiftedTubeRig::Conditions() const {
  const LiftedTubeOptions& options = rig_case().rig.lifted_tube;
  return {{"lift_velocity_m_per_s", options.lift_velocity},
          {"plate_over_mean_diameter", options.plate_diameter / MeanDiameter()}};
}

std::vector<std::string> LiftedTubeRig::Warnings(GrainSpan heap) const {
  std::vector<std::string> warnings;
  if (heap.empty()) warnings.push_back("nothing is left on the plate");
  const double carried = memory().mass_carried / FilledMass();
  if (carried > kMuchCarried) {
    warnings.push_back(
        base::InPercent(carried) + " % of the powder (" +
        base::Counted(memory().num_carried, "grain") +
        ") stuck in the tube and left with it: it is neither on the plate nor fallen");
  }
  const auto length = rig_case().rig.lifted_tube.tube_length;
  if (length && state().bed.height > *length) {
    warnings.push_back("the bed, " + base::ShortNumber(1e3 * state().bed.height) +
                       " mm high, stood above the tube of " + base::ShortNumber(1e3 * *length) +
                       " mm: lengthen it");
  }
  return warnings;
}

const RigEntry kLiftedTubeRig = EntryFor<LiftedTubeRig>(RigKind::kLiftedTube);

}  // namespace talus::rigs
