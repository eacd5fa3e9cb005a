#include "experiments/analysis/next/usual_tests.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/shear_cell/squeeze.h"

namespace talus::analysis {
namespace {

bool Alike(double a, double b) { return std::abs(a - b) <= 0.01 * b; }

// Two plates that grains slide and roll on alike.
bool IsSamePlate(const rigs::Device& a, const rigs::Device& b, const engine::Material& powder) {
  const engine::Material one = a.plate_material.value_or(rigs::WallMaterial{}).Over(powder);
  const engine::Material other = b.plate_material.value_or(rigs::WallMaterial{}).Over(powder);
  return Alike(one.sliding_friction, other.sliding_friction) &&
         Alike(one.rolling_friction, other.rolling_friction);
}

bool IsMade(const campaign::JointView& view, const TestCandidate& test) {
  const auto all = campaign::ExperimentsOf(view.spec);
  return std::any_of(all.begin(), all.end(), [&](const campaign::ExperimentSpec& made) {
    if (rigs::KindOf(made.rig) != rigs::KindOf(test.rig)) return false;
    if (rigs::KindOf(test.rig) != rigs::RigKind::kLiftedTube) return true;
    return Alike(made.device->plate_diameter, test.device->plate_diameter) &&
           Alike(made.device->lift_velocity, test.device->lift_velocity) &&
           IsSamePlate(*made.device, *test.device, view.spec.powder.material);
  });
}

// Whether the campaign searches a property of its plate, which a rough one would be given, too.
bool SearchesPlate(const campaign::JointView& view) {
  return std::any_of(view.space.parameters.begin(), view.space.parameters.end(),
                     [](const auto& p) { return campaign::PlaceOf(p.name).body == rigs::kFloor; });
}

// What holds on another plate than the experiment's.
std::vector<engine::PairSpec> WithoutPlate(std::vector<engine::PairSpec> pairs) {
  std::erase_if(pairs, [](const auto& pair) { return rigs::PartnerOf(pair) == rigs::kFloor; });
  return pairs;
}

// The tube that is at hand, on other plates and lifted otherwise.
void AddPlates(const campaign::JointView& view, std::vector<TestCandidate>& tests) {
  const campaign::ExperimentSpec first = campaign::ExperimentsOf(view.spec).front();
  const rigs::Device device = UsualTube(view.spec);
  constexpr double kWide = 3;     // plate over tube
  constexpr double kSlow = 0.05;  // [m/s]
  constexpr double kFast = 0.20;  // [m/s]
  constexpr double kRough = 1.0;  // friction of a plate that grains are glued to
  const rigs::RigOptions tube{};
  rigs::Device slow = device;
  slow.plate_diameter = kWide * device.tube_inner_diameter;
  slow.plate = rigs::PlateKind::kDisc;
  slow.lift_velocity = kSlow;
  rigs::Device fast = slow;
  fast.lift_velocity = kFast;
  rigs::Device rough = device;
  rigs::WallMaterial material = device.plate_material.value_or(rigs::WallMaterial{});
  material.sliding_friction = kRough;
  material.rolling_friction = kRough;
  rough.plate_material = material;
  tests.push_back({.name = "wide plate, 5 cm/s", .rig = tube, .device = slow});
  tests.push_back({.name = "wide plate, 20 cm/s", .rig = tube, .device = fast});
  if (SearchesPlate(view)) return;
  tests.push_back(
      {.name = "rough plate", .rig = tube, .device = rough, .pairs = WithoutPlate(*first.pairs)});
}

rigs::RigOptions OptionsOfKind(rigs::RigKind kind) {
  rigs::RigOptions options;
  options.kind = kind;
  return options;
}

double UpToMillimetre(double length) { return 1e-3 * std::ceil(1e3 * length); }

// Volume of the first experiment's powder, which the tests here take, too [m³].
double BulkVolume(const campaign::CampaignSpec& spec) {
  constexpr double kPacked = 0.6;  // solid fraction
  const double mass = campaign::ExperimentsOf(spec).front().mass.value_or(spec.powder.mass);
  return mass / (kPacked * spec.powder.material.density);
}

// Diameter of a cylinder that so much powder fills as high as it is wide.
double CylinderFor(double volume) {
  return UpToMillimetre(std::cbrt(4 * volume / std::numbers::pi));
}

const rigs::FillingRule kPoured{.kind = rigs::FillingKind::kPour};
const rigs::FillingRule kDense{};

// Stresses that hard grains are tested under, or as much of them as these bear.
std::vector<double> StressesFor(const campaign::CampaignSpec& spec, std::vector<double> stresses) {
  rigs::Case c;
  c.powder = spec.powder;
  c.models = spec.models;
  const double share = std::min(1.0, rigs::BearableStress(c) / stresses.back());
  for (double& stress : stresses) stress *= share;
  return stresses;
}

// The largest grain as a test is simulated first, with the largest scale factor.
double LargestSimulated(const campaign::CampaignSpec& spec) {
  rigs::Case c;
  c.powder = spec.powder;
  c.coarse_graining.scale_factor = spec.coarse_graining.Levels().front();
  return rigs::LargestDiameter(c);
}

// An orifice that coarse grains pass, too, under a cylinder as wide as its filling is high; a plate
// that a heap of some 30 degrees overflows, with funnel and height in the proportions of ISO 4324
// and a rim that keeps the lowest layer, as grains that rebound from a bare plate leave none; a
// drum four times as wide as deep, two fifths full. Times are those of seconds, not minutes.
void AddFlows(const campaign::CampaignSpec& spec, double volume,
              std::vector<TestCandidate>& tests) {
  const double grain = LargestSimulated(spec);
  rigs::RigOptions flow = OptionsOfKind(rigs::RigKind::kOrificeFlow);
  flow.orifice_flow.diameter = CylinderFor(volume);
  flow.orifice_flow.orifice = std::min(UpToMillimetre(6 * grain), 0.6 * flow.orifice_flow.diameter);
  rigs::RigOptions heap = OptionsOfKind(rigs::RigKind::kFunnelHeap);
  heap.funnel_heap.plate_diameter = UpToMillimetre(std::cbrt(12 * volume));
  heap.funnel_heap.outlet =
      UpToMillimetre(std::max(0.1 * heap.funnel_heap.plate_diameter, 4 * grain));
  heap.funnel_heap.height = 0.75 * heap.funnel_heap.plate_diameter;
  heap.funnel_heap.rim_height = grain;
  rigs::RigOptions drum = OptionsOfKind(rigs::RigKind::kDrum);
  drum.drum.diameter = UpToMillimetre(std::cbrt(40 * volume / std::numbers::pi));
  drum.drum.width = drum.drum.diameter / 4;
  drum.drum.speed = 30 * rigs::kRpm;
  drum.drum.start_turns = 0.25;
  drum.drum.turns = 0.25;
  tests.push_back({.name = "orifice flow", .rig = flow, .filling = kDense});
  tests.push_back({.name = "funnel heap", .rig = heap, .filling = kPoured});
  tests.push_back({.name = "drum, 30 rpm", .rig = drum, .filling = kDense});
}

// Cylinder as high as wide; column twice as high as long; box five times as long as high; shear
// cell a quarter wider than high.
void AddVessels(const campaign::CampaignSpec& spec, double volume,
                std::vector<TestCandidate>& tests) {
  rigs::RigOptions tapped = OptionsOfKind(rigs::RigKind::kTappedDensity);
  tapped.tapped_density.diameter = CylinderFor(volume);
  rigs::RigOptions column = OptionsOfKind(rigs::RigKind::kColumnCollapse);
  column.column_collapse.length = UpToMillimetre(std::cbrt(volume / 2));
  column.column_collapse.width = column.column_collapse.length;
  rigs::RigOptions box = OptionsOfKind(rigs::RigKind::kTiltingBox);
  box.tilting_box.length = UpToMillimetre(std::cbrt(10 * volume));
  box.tilting_box.width = box.tilting_box.length / 2;
  rigs::RigOptions cell = OptionsOfKind(rigs::RigKind::kShearCell);
  cell.shear_cell.diameter = UpToMillimetre(std::cbrt(5 * volume / std::numbers::pi));
  cell.shear_cell.stresses = StressesFor(spec, cell.shear_cell.stresses);
  tests.push_back({.name = "tapped density", .rig = tapped, .filling = kPoured});
  tests.push_back({.name = "column collapse", .rig = column, .filling = kDense});
  tests.push_back({.name = "tilting box", .rig = box, .filling = kDense});
  tests.push_back({.name = "shear cell", .rig = cell, .filling = kDense});
}

}  // namespace

std::vector<TestCandidate> UsualTests(const campaign::JointView& view) {
  std::vector<TestCandidate> tests;
  AddPlates(view, tests);
  const double volume = BulkVolume(view.spec);
  AddVessels(view.spec, volume, tests);
  AddFlows(view.spec, volume, tests);
  std::erase_if(tests, [&](const TestCandidate& test) { return IsMade(view, test); });
  return tests;
}

}  // namespace talus::analysis
