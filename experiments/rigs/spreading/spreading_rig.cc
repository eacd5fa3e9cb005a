#include "experiments/rigs/spreading/spreading_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/text/number_text.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/phased/surface.h"

namespace talus::rigs {
namespace {

constexpr int kBlade = 0;
constexpr int kGate = 1;
constexpr double kEnds = 0.15;      // of the plate at either end, which the layer is not read on
constexpr double kBladeHeight = 3;  // heights of the heap: it piles up before the blade

}  // namespace

SpreadingRig::SpreadingRig(const Case& c, State state, engine::Simulation simulation)
    : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
  const SpreadingOptions& o = c.rig.spreading;
  Phase spreading = Lasting("spreading", (o.feed + o.length) / o.speed);
  spreading.begin = [this] { Start(); };
  spreading.end = [this] { Stop(); };
  SetPhases({spreading, Resting("resting", c.rules.heap)}, TestTime(c, FilledHeight(c, vessel())));
}

void SpreadingRig::Start() {
  scene().SetMotion(kBlade,
                    {{.time = scene().time(), .velocity = {rig_case().rig.spreading.speed, 0, 0}}});
  scene().RemoveWall(kGate);
}

void SpreadingRig::Stop() { scene().SetMotion(kBlade, {{.time = scene().time()}}); }

double SpreadingRig::GapOf(const Case& c) {
  return c.rig.spreading.gap.value_or(3 * engine::SizeCurve(c.powder.sizes).VolumeQuantile(0.9));
}

std::vector<engine::Wall> SpreadingRig::Walls(const Case& c, double height) {
  const SpreadingOptions& o = c.rig.spreading;
  const double gap = GapOf(c);
  const auto upright = [&](double x, double low, double high) {
    return engine::Rectangle{.center = {x, 0, (low + high) / 2},
                             .normal = {1, 0, 0},
                             .edge = {0, 1, 0},
                             .width = o.width,
                             .height = high - low};
  };
  const auto side = [](double y, double normal) {
    return engine::Plane{.point = {0, y, 0}, .normal = {0, normal, 0}};
  };
  const engine::Rectangle platform{
      .center = {-o.feed / 2, 0, gap}, .width = o.feed, .height = o.width};
  return {{.name = "blade",
           .shape = upright(-o.feed, gap, gap + kBladeHeight * height),
           .material = kWalls},
          {.name = "gate", .shape = upright(0, gap, gap + 1.5 * height), .material = kWalls},
          {.name = "plate", .shape = engine::Plane{}, .material = kFloor},
          {.name = "platform", .shape = platform, .material = kFloor},
          {.name = "step", .shape = upright(0, 0, gap), .material = kFloor},
          {.name = "front", .shape = side(-o.width / 2, 1), .material = kWalls},
          {.name = "back", .shape = side(o.width / 2, -1), .material = kWalls}};
}

Vessel SpreadingRig::VesselOf(const Case& c) {
  const SpreadingOptions& o = c.rig.spreading;
  return BoxVessel({-o.feed / 2, 0, GapOf(c)}, o.feed, o.width);
}

void SpreadingRig::Validate(const Case& c, base::Problems& problems) {
  const SpreadingOptions& o = c.rig.spreading;
  problems.Require(!c.filling.taps, "filling.taps", "are not of this rig: remove them");
  problems.Require(o.length > 5 * LargestDiameter(c), "rig.length", o.length,
                   "must be above five (scaled) grain diameters: a layer is read on it");
  const double higher = FilledHeight(c, VesselOf(c)) / o.feed;
  problems.Require(
      higher <= 3, "powder.mass", c.powder.mass,
      "stands " + base::ShortNumber(higher) +
          " times as high as its platform is long, must be 3 or less; take less powder "
          "or a longer rig.feed");
}

double SpreadingRig::Width(const Case& c) { return c.rig.spreading.length; }

double SpreadingRig::TestTime(const Case& c, double) {
  const SpreadingOptions& o = c.rig.spreading;
  return (o.feed + o.length) / o.speed;
}

// Away from both ends, and from the side walls by a grain where the strip has room.
LayerWindow SpreadingRig::Window() const {
  const SpreadingOptions& o = rig_case().rig.spreading;
  const double beside = LargestDiameter(rig_case());
  return {.from = kEnds * o.length,
          .to = (1 - kEnds) * o.length,
          .half_width = o.width > 4 * beside ? o.width / 2 - beside : o.width / 2};
}

double SpreadingRig::MassAhead(GrainSpan grains) const {
  double mass = 0;
  for (const engine::Particle& p : grains) {
    if (p.position.x > rig_case().rig.spreading.length) mass += MassOf({&p, 1});
  }
  return mass;
}

// Mean diameter by volume in the last third of the window over that in the first.
Reading SpreadingRig::SizeDrift(GrainSpan grains) const {
  const LayerWindow window = Window();
  double volume[3] = {};
  double moment[3] = {};
  for (const engine::Particle& p : grains) {
    if (!window.Holds(p)) continue;
    const double place = (p.position.x - window.from) / (window.to - window.from);
    const int third = std::min(2, static_cast<int>(3 * place));
    const double cube = p.radius * p.radius * p.radius;
    volume[third] += cube;
    moment[third] += cube * 2 * p.radius;
  }
  if (!(volume[0] > 0) || !(volume[2] > 0)) {
    return {.observable = Observable::kSizeDrift, .undefined = "an end of the layer has no grains"};
  }
  return {Observable::kSizeDrift, (moment[2] / volume[2]) / (moment[0] / volume[0])};
}

std::vector<Reading> SpreadingRig::Readings(GrainSpan grains) const {
  const double length = rig_case().rig.spreading.length;
  const LayerWindow window = Window();
  double seen = 0;   // in the window [kg]
  double plate = 0;  // on the whole plate [kg]
  for (const engine::Particle& p : grains) {
    if (window.Holds(p)) seen += MassOf({&p, 1});
    if (p.position.x >= 0 && p.position.x <= length) plate += MassOf({&p, 1});
  }
  const double solid = seen / rig_case().powder.material.density;
  const Layer layer = LayerOf(grains, window, MeanDiameter());
  return {{Observable::kPackingFraction, solid / (window.Area() * GapOf(rig_case()))},
          {Observable::kThickness, layer.thickness},
          {Observable::kCoverage, layer.coverage},
          {Observable::kRoughness, layer.roughness},
          {Observable::kLayerMass, plate},
          {Observable::kMassAhead, MassAhead(grains)},
          SizeDrift(grains)};
}

std::vector<std::string> SpreadingRig::Warnings(GrainSpan grains) const {
  const double least = 0.02 * FilledMass();
  if (MassAhead(grains) > least) return {};
  return {
      "the heap was used up before the blade reached the plate's end: its last part had no "
      "powder before the blade; take more"};
}

}  // namespace talus::rigs
