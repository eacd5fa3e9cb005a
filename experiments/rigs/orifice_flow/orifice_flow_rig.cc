// How fast a powder runs through a round orifice, and whether it does: a cylinder with a flat floor
// or a cone. z = 0 is the orifice. It flows where more than a tenth of the powder runs out before
// an arch stands; else the rate is 0.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/phased/contact_sets.h"
#include "experiments/rigs/phased/flow.h"
#include "experiments/rigs/phased/gate.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/rig_entry.h"

namespace talus::rigs {
namespace {

constexpr const char* kDischarging = "discharging";
constexpr int kOrificeFloor = 1;  // indices of the walls
constexpr int kOrificeCylinder = 2;

// The cone's height [m]; 0 of a flat floor.
double ConeHeight(const OrificeFlowOptions& options) {
  if (!options.cone_angle) return 0;
  return (options.diameter - options.orifice) / 2 / std::tan(*options.cone_angle / 2);
}

engine::WallShape FloorOf(const OrificeFlowOptions& options) {
  const double inner = options.orifice / 2;
  const double outer = options.diameter / 2;
  if (!options.cone_angle) return engine::Annulus{.inner_radius = inner, .radius = outer};
  return engine::Cone{.radius = inner, .top_radius = outer, .length = ConeHeight(options)};
}

struct OrificeFlowMemory {
  std::vector<Passed> flow{};
  double mass_gone = 0;  // out of the scene [kg]

  static constexpr base::FieldKey kKeys[] = {{"mass_gone", "mass_gone_kg"}};
  TALUS_FIELDS(flow, mass_gone);
};

class OrificeFlowRig : public RememberingRig<OrificeFlowMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kDischargeRate, true},
                                                {Observable::kDischargeTime},
                                                {Observable::kFlows},
                                                {Observable::kMassFallen},
                                                {Observable::kMassLeft}};

  // What has run out falls for some diameters before it leaves the scene.
  OrificeFlowRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)),
        leave_height_(-c.rules.leave_depth * LargestDiameter(c)) {
    const double filled = FilledHeight(c, vessel());
    Phase discharging = Resting(kDischarging, c.rules.heap, [this] {
      return HasStopped(memory().flow, rig_case().rules.heap.hold_time);
    });
    discharging.hold_time = c.rig.orifice_flow.arch_time;
    const double emptying = EmptyingTime(c, filled) + c.rig.orifice_flow.arch_time;
    discharging.cap = [longest = 5 * emptying + c.rules.heap.max_time] { return longest; };
    discharging.filmed = true;
    discharging.begin = [this] { scene().RemoveWall(kGate); };
    SetPhases({discharging}, TestTime(c, filled));
  }

  static Vessel VesselOf(const Case& c) {
    engine::FillRegion region;
    region.diameter = c.rig.orifice_flow.diameter;
    region.base = {0, 0, ConeHeight(c.rig.orifice_flow)};
    return {.region = region,
            .area = region.Area(),
            .across = c.rig.orifice_flow.diameter,
            .floor = 0,
            .is_prism = !c.rig.orifice_flow.cone_angle};
  }

  static std::vector<engine::Wall> Walls(const Case& c, double height) {
    const OrificeFlowOptions& options = c.rig.orifice_flow;
    const double headroom = Headroom(c, VesselOf(c), c.filling.taps);
    const engine::OpenCylinder cylinder{.base = {0, 0, ConeHeight(options)},
                                        .radius = options.diameter / 2,
                                        .length = std::max(1.2 * height, height + headroom)};
    return {
        {.name = "gate", .shape = engine::Disc{.radius = options.orifice / 2}, .material = kFloor},
        {.name = "floor", .shape = FloorOf(options), .material = kFloor},
        {.name = "cylinder", .shape = cylinder, .material = kWalls}};
  }

  static void Validate(const Case& c, base::Problems& problems) {
    problems.Require(c.rig.orifice_flow.orifice > LargestDiameter(c), "rig.orifice",
                     c.rig.orifice_flow.orifice,
                     "must be above one (scaled) grain diameter, or nothing can run through it");
  }

  static double Width(const Case& c) { return c.rig.orifice_flow.diameter; }

  // As Beverloo's law has it, 0.58 ρ_b √g (D - 1.5 d)^2.5, for the larger part of it.
  static double EmptyingTime(const Case& c, double filled_height) {
    const OrificeFlowOptions& options = c.rig.orifice_flow;
    const double rate =
        0.58 * std::sqrt(c.gravity) * std::pow(0.7 * options.orifice, 2.5);  // [m³/s]
    return filled_height * VesselOf(c).area / rate;
  }

  // A cone empties. On a flat floor a rest stays, which has to be looked at for long.
  static double TestTime(const Case& c, double filled_height) {
    const double emptying = EmptyingTime(c, filled_height);
    if (c.rig.orifice_flow.cone_angle) return 0.85 * emptying;
    return emptying + c.rig.orifice_flow.arch_time + kRestTime;
  }

 protected:
  std::optional<PhaseEnd> Look() override {
    if (phase_name() != kDischarging) return std::nullopt;
    const auto leaves = [&](const engine::Particle& p) {
      return p.position.z + p.radius < leave_height_;
    };
    WeighOut(leaves, memory().mass_gone);
    memory().flow.push_back(
        {.time = simulation().time() - phase_start(), .mass = MassBelow(view().particles)});
    if (view().particles.empty()) return PhaseEnd::kEmpty;
    return std::nullopt;
  }

  std::vector<Reading> Readings(GrainSpan grains) const override {
    const double filled = FilledMass();
    const double passed = MassFallen(grains);
    const bool flows = HasFlowed(passed, filled) || (passed > 0 && IsFree(grains));
    std::vector<Reading> all =
        FlowReadings(memory().flow, passed, flows, "an arch stands above the orifice");
    all.push_back({Observable::kFlows, flows ? 1.0 : 0.0});
    all.push_back({Observable::kMassFallen, passed});
    all.push_back({Observable::kMassLeft, MassLeft(filled, passed)});
    return all;
  }

 private:
  // What is below the orifice, or gone [kg].
  double MassBelow(GrainSpan grains) const {
    double mass = memory().mass_gone;
    for (const engine::Particle& p : grains) {
      if (p.position.z < 0) mass += MassOf({&p, 1});
    }
    return mass;
  }

  // The same without what hangs under the orifice, from an arch or the floor's edge [kg].
  double MassFallen(GrainSpan grains) const {
    const std::vector<engine::ContactInfo> contacts = simulation().Contacts();
    const std::vector<bool> hangs =
        ContactSets(grains, contacts).Hanging({kOrificeFloor, kOrificeCylinder});
    std::vector<engine::Particle> free;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      if (!hangs[i]) free.push_back(grains[i]);
    }
    return MassBelow(free);
  }

  // A shallow bed on a flat floor is left with a crater over the orifice: less than a tenth of it
  // may have run out, and no arch stands.
  bool IsFree(GrainSpan grains) const {
    const double inner = std::max(rig_case().rig.orifice_flow.orifice / 4, MeanDiameter());
    return std::ranges::none_of(grains, [&](const engine::Particle& p) {
      return p.position.z > 0 && std::hypot(p.position.x, p.position.y) < inner;
    });
  }

  double leave_height_ = 0;  // below which grains leave the scene [m]
};

}  // namespace

const RigEntry kOrificeFlowRig = EntryFor<OrificeFlowRig>(RigKind::kOrificeFlow);

}  // namespace talus::rigs
