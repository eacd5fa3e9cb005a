// How fast a powder runs through a slot, how much stays above, and the slopes that it leaves above
// and below. x is across the slot, its origin in the slot's middle; z = 0 is the lower floor.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/phased/contact_sets.h"
#include "experiments/rigs/phased/flow.h"
#include "experiments/rigs/phased/gate.h"
#include "experiments/rigs/phased/landing.h"
#include "experiments/rigs/phased/rig_entry.h"
#include "experiments/rigs/phased/surface.h"

namespace talus::rigs {
namespace {

constexpr int kLeftShelf = 1;  // indices of the walls
constexpr int kRightShelf = 2;
constexpr int kLowerFloor = 3;
constexpr const char* kNoFlow = "less than a tenth ran through the slot";

class DrawDownRig : public RememberingRig<FlowMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {
      {Observable::kMassFallen},          {Observable::kMassLeft, true},
      {Observable::kDischargeTime, true}, {Observable::kDischargeRate},
      {Observable::kAngle, true},         {Observable::kShearAngle}};

  DrawDownRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
    Phase discharging = Resting("discharging", c.rules.heap, [this] {
      return HasStopped(memory().flow, rig_case().rules.heap.hold_time);
    });
    const double filled = FilledHeight(c, vessel());
    discharging.cap = [longest = 5 * EmptyingTime(c, filled) + c.rules.heap.max_time] {
      return longest;
    };
    discharging.filmed = true;
    discharging.begin = [this] { scene().RemoveWall(kGate); };
    SetPhases({discharging}, TestTime(c, filled));
  }

  static Vessel VesselOf(const Case& c) {
    const DrawDownOptions& box = c.rig.draw_down;
    return BoxVessel({0, 0, box.height}, box.length, box.width);
  }

  static std::vector<engine::Wall> Walls(const Case& c, double) {
    const DrawDownOptions& box = c.rig.draw_down;
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

  static void Validate(const Case& c, base::Problems& problems) {
    problems.Require(c.rig.draw_down.slot > 2 * LargestDiameter(c), "rig.slot",
                     c.rig.draw_down.slot,
                     "must be above two (scaled) grain diameters, or nothing runs through it");
  }

  static double Width(const Case& c) { return c.rig.draw_down.length; }

  // As Beverloo's law has it for a slot, 1.03 ρ_b √g W (D - 1.4 d)^1.5, ten diameters wide.
  static double EmptyingTime(const Case& c, double filled_height) {
    const DrawDownOptions& box = c.rig.draw_down;
    const double rate = std::sqrt(c.gravity) * std::pow(0.8 * box.slot, 1.5);  // of area [m²/s]
    return filled_height * box.length / rate;
  }

  // Half of it runs out, and what has fallen rolls to rest: as seen in fourteen boxes of 9 to 48
  // mm.
  static double TestTime(const Case& c, double filled_height) {
    return 0.5 * EmptyingTime(c, filled_height) +
           12 * std::sqrt(c.rig.draw_down.length / c.gravity);
  }

 protected:
  std::optional<PhaseEnd> Look() override {
    if (phase_name() == "discharging") {
      memory().flow.push_back(
          {.time = simulation().time() - phase_start(), .mass = MassBelow(view().particles)});
    }
    return std::nullopt;
  }

  std::vector<Reading> Readings(GrainSpan grains) const override {
    const DrawDownOptions& box = rig_case().rig.draw_down;
    const std::vector<engine::ContactInfo> contacts = simulation().Contacts();
    const ContactSets sets(grains, contacts);
    const std::vector<bool> hangs = sets.Hanging({kLeftShelf, kRightShelf}, kLowerFloor);
    std::vector<bool> lies = sets.Reaching(kLowerFloor);
    AddLanding(grains, box.length / 2, lies);
    // Both halves are one, seen at |x|. What hangs under a shelf has not fallen, and is no slope;
    // what still falls has, but is none of the heap.
    std::vector<engine::Particle> above, below, heap;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      engine::Particle p = grains[i];
      p.position.x = std::abs(p.position.x);
      if (p.position.z >= box.height) {
        above.push_back(p);
        continue;
      }
      if (!hangs[i]) below.push_back(p);
      if (!hangs[i] && lies[i]) heap.push_back(p);
    }
    const double passed = MassOf(below);
    std::vector<Reading> all{{Observable::kMassFallen, passed},
                             {Observable::kMassLeft, MassLeft(FilledMass(), passed)}};
    const bool flows = HasFlowed(passed, FilledMass());
    for (Reading& reading : FlowReadings(memory().flow, passed, flows, kNoFlow)) {
      all.push_back(std::move(reading));
    }
    if (!flows) {
      all.push_back({.observable = Observable::kAngle, .undefined = kNoFlow});
      all.push_back({.observable = Observable::kShearAngle, .undefined = kNoFlow});
      return all;
    }
    const double foot = MassQuantile(heap, 0.98, [](const auto& p) { return p.position.x; });
    all.push_back(
        AngleOf(Observable::kAngle,
                SurfaceOf(heap, {.from = 0.2 * foot, .to = 0.8 * foot, .width = MeanDiameter()})));
    // The face that the powder failed at; beyond it the top is level as it was.
    const SurfaceStrips shelf{.from = box.slot / 2, .to = box.length / 2, .width = MeanDiameter()};
    all.push_back(AngleOf(
        Observable::kShearAngle,
        Sunken(SurfaceOf(above, shelf), {.floor = box.height, .height = state().bed.height})));
    return all;
  }

 private:
  // Beneath the shelves [kg].
  double MassBelow(GrainSpan grains) const {
    const double height = rig_case().rig.draw_down.height;
    double mass = 0;
    for (const engine::Particle& p : grains) {
      if (p.position.z < height) mass += MassOf({&p, 1});
    }
    return mass;
  }
};

}  // namespace

const RigEntry kDrawDownRig = EntryFor<DrawDownRig>(RigKind::kDrawDown);

}  // namespace talus::rigs
