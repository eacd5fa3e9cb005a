// How far a column runs out. x is along the channel, its origin in the middle of the column.
//
//   runout = x of the front - L/2     the front: where the layer on the floor ends (surface.h)
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/counted.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/phased/contact_sets.h"
#include "experiments/rigs/phased/gate.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/rig_entry.h"
#include "experiments/rigs/phased/surface.h"

namespace talus::rigs {
namespace {

constexpr const char* kRunningOut = "running out";
constexpr int kColumnFloor = 1;  // index of the wall

struct GateMemory {
  std::int64_t num_carried = 0;  // grains that went with the gate
  double mass_carried = 0;       // [kg]

  static constexpr base::FieldKey kKeys[] = {{"mass_carried", "mass_carried_kg"}};
  TALUS_FIELDS(num_carried, mass_carried);
};

class ColumnCollapseRig : public RememberingRig<GateMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kRunout, true},
                                                {Observable::kHeight, true},
                                                {Observable::kAngle},
                                                {Observable::kColumnHeight},
                                                {Observable::kAspectRatio}};

  ColumnCollapseRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
    // Until the gate is out of its way the column rests.
    Phase running = Resting(kRunningOut, c.rules.heap, [this] { return GateIsUp(); });
    running.filmed = true;
    running.begin = [this] { Open(); };
    running.cap = [this, longest = c.rules.heap.max_time] { return longest + OpeningTime(); };
    SetPhases({running}, TestTime(c, FilledHeight(c, vessel())));
  }

  static Vessel VesselOf(const Case& c) {
    const ColumnCollapseOptions& channel = c.rig.column_collapse;
    return BoxVessel({}, channel.length, channel.width);
  }

  static std::vector<engine::Wall> Walls(const Case& c, double height) {
    const ColumnCollapseOptions& channel = c.rig.column_collapse;
    const double top = std::max(1.5 * height, height + Headroom(c, VesselOf(c), c.filling.taps));
    const engine::Rectangle gate{.center = {channel.length / 2, 0, top / 2},
                                 .normal = {1, 0, 0},
                                 .edge = {0, 1, 0},
                                 .width = channel.width,
                                 .height = top};
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

  static double Width(const Case& c) { return c.rig.column_collapse.length; }

  // It falls and runs out in a few times √(h/g).
  static double TestTime(const Case& c, double filled_height) {
    const auto& velocity = c.rig.column_collapse.gate_velocity;
    return 3 * std::sqrt(filled_height / c.gravity) + (velocity ? filled_height / *velocity : 0) +
           kRestTime;
  }

 protected:
  std::optional<PhaseEnd> Look() override {
    if (phase_name() == kRunningOut && GateIsUp() && !simulation().IsRemoved(kGate)) DropGate();
    return std::nullopt;
  }

  std::vector<Reading> Readings(GrainSpan grains) const override {
    const double length = rig_case().rig.column_collapse.length;
    const double front = Front(grains);
    // Grains that cling to a gate that has not come up are none of the heap.
    const std::vector<engine::ContactInfo> contacts = simulation().Contacts();
    const std::vector<bool> stands = ContactSets(grains, contacts).Reaching(kColumnFloor);
    double top = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      if (stands[i]) top = std::max(top, grains[i].position.z + grains[i].radius);
    }
    const double runout = front - length / 2;
    std::vector<Reading> all{{Observable::kRunout, runout},
                             {Observable::kHeight, top},
                             {Observable::kColumnHeight, state().bed.height},
                             {Observable::kAspectRatio, state().bed.height / length}};
    if (!(runout > 0)) {
      all.push_back({.observable = Observable::kAngle, .undefined = "the column stands"});
      return all;
    }
    // Between the foot of the end wall, or the top that has not moved, and the thin front.
    const FormerBed bed{.height = state().bed.height};
    const SurfaceStrips whole{.from = -length / 2, .to = front, .width = MeanDiameter()};
    const double start = EndOfUnmoved(SurfaceOf(grains, whole), bed).value_or(whole.from);
    const SurfaceStrips middle{.from = start + 0.2 * (front - start),
                               .to = start + 0.8 * (front - start),
                               .width = MeanDiameter()};
    all.push_back(AngleOf(Observable::kAngle, Sunken(SurfaceOf(grains, middle), bed)));
    return all;
  }

  std::vector<std::string> Warnings(GrainSpan grains) const override {
    std::vector<std::string> warnings;
    if (memory().num_carried > 0) {
      warnings.push_back(base::Counted(memory().num_carried, "grain") +
                         " clung to the gate and went up with it");
    }
    if (Front(grains) > rig_case().rig.column_collapse.length / 2) return warnings;
    warnings.push_back("the column stands: no layer of it ran out from behind the gate");
    return warnings;
  }

 private:
  // x of it; the gate's where nothing has run out.
  double Front(GrainSpan grains) const {
    const ColumnCollapseOptions& channel = rig_case().rig.column_collapse;
    return EndOfLayer(grains, channel.length / 2, channel.width, MeanDiameter());
  }

  // That the gate takes to the top of the bed [s].
  double OpeningTime() const {
    const auto& velocity = rig_case().rig.column_collapse.gate_velocity;
    return velocity ? state().bed.height / *velocity : 0;
  }

  // The column only sinks from its first height on.
  bool GateIsUp() const { return simulation().time() - phase_start() > OpeningTime(); }

  // It has left the column, with what clings to it and stands on nothing.
  void DropGate() {
    const std::vector<bool> hangs =
        ContactSets(view().particles, view().contacts).Hanging({kGate}, kColumnFloor);
    std::vector<std::int64_t> carried;
    for (std::size_t i = 0; i < hangs.size(); ++i) {
      if (hangs[i]) carried.push_back(view().particles[i].id);
    }
    scene().RemoveWall(kGate);
    memory().num_carried += WeighOut(carried, memory().mass_carried);
  }

  void Open() {
    const auto& velocity = rig_case().rig.column_collapse.gate_velocity;
    if (!velocity) return scene().RemoveWall(kGate);
    scene().SetMotion(kGate, {{.time = scene().time(), .velocity = {0, 0, *velocity}}});
  }
};

}  // namespace

const RigEntry kColumnCollapseRig = EntryFor<ColumnCollapseRig>(RigKind::kColumnCollapse);

}  // namespace talus::rigs
