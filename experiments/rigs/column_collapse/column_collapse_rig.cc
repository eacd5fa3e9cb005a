// How far a column runs out. x is along the channel, its origin in the middle of the column.
//
//   runout = x of the front - L/2     the front: where the layer on the floor ends (surface.h)
//
// A powder of hardly any sliding or rolling friction runs out to less than a layer, and has no
// front.
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
constexpr const char* kStands = "the column stands";
constexpr const char* kNoLayer = "it ran out to less than a layer";

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
    const LayerOnFloor layer = LayerBeyondGate(grains);
    const bool has_front = !RanOutToLess(grains, layer);
    // Grains that cling to a gate that has not come up are none of the heap.
    const std::vector<engine::ContactInfo> contacts = simulation().Contacts();
    const std::vector<bool> stands = ContactSets(grains, contacts).Reaching(kColumnFloor);
    double top = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      if (stands[i]) top = std::max(top, grains[i].position.z + grains[i].radius);
    }
    Reading runout{Observable::kRunout};
    if (has_front) {
      runout.value = layer.end - layer.begin;
    } else {
      runout.undefined = kNoLayer;
    }
    std::vector<Reading> all{runout,
                             {Observable::kHeight, top},
                             {Observable::kColumnHeight, state().bed.height},
                             {Observable::kAspectRatio, state().bed.height / length}};
    if (!has_front || !(runout.value > 0)) {
      all.push_back(
          {.observable = Observable::kAngle, .undefined = has_front ? kStands : kNoLayer});
      return all;
    }
    // Between the foot of the end wall, or the top that has not moved, and the thin front.
    const FormerBed bed{.height = state().bed.height};
    const double front = layer.end;
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
    const LayerOnFloor layer = LayerBeyondGate(grains);
    if (RanOutToLess(grains, layer)) {
      warnings.push_back(std::string(kNoLayer) +
                         ": most of what left the gate lies beyond the end of its layer, and there "
                         "is no front that a runout and an angle could be read to");
    } else if (!(layer.end > layer.begin)) {
      warnings.push_back(std::string(kStands) + ": no layer of it ran out from behind the gate");
    }
    return warnings;
  }

 private:
  bool RanOutToLess(GrainSpan grains, const LayerOnFloor& layer) const {
    const double length = rig_case().rig.column_collapse.length;
    return IsLessThanALayer(grains, layer, std::min(1.0, state().bed.height / length));
  }

  // Beyond the gate; it ends where it begins if nothing has run out.
  LayerOnFloor LayerBeyondGate(GrainSpan grains) const {
    const ColumnCollapseOptions& channel = rig_case().rig.column_collapse;
    const double gate = channel.length / 2;
    return {.begin = gate, .end = EndOfLayer(grains, gate, channel.width, MeanDiameter())};
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
