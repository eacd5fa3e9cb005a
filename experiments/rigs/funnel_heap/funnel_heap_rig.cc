// The heap that powder makes when it runs out of a funnel at a fixed height onto a plate, with a
// rim or without. The plate's top is z = 0 in the scene. A photograph shows rim and plate as one
// dark body, so that in images, and for height and angles, the rim's top is.
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/phased/landing.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/repose.h"
#include "experiments/rigs/phased/rig_entry.h"
#include "experiments/rigs/phased/spheres.h"

namespace talus::rigs {
namespace {

constexpr double kThickness = 0.005;  // of the plate [m]
constexpr int kFunnelPlate = 0;       // index of the wall

struct FunnelHeapMemory {
  double mass_fallen = 0;  // out of the scene [kg]

  static constexpr base::FieldKey kKeys[] = {{"mass_fallen", "mass_fallen_kg"}};
  TALUS_FIELDS(mass_fallen);
};

class FunnelHeapRig : public RememberingRig<FunnelHeapMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kMassOnPlate, true},
                                                {Observable::kMassFallen},
                                                {Observable::kHeight},
                                                {Observable::kReposeAngle1},
                                                {Observable::kReposeAngle2},
                                                {Observable::kReposeAngle3},
                                                {Observable::kReposeTriangle, true},
                                                {Observable::kStaticCohesiveIndex}};

  FunnelHeapRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)),
        leave_height_(-c.rules.leave_depth * LargestDiameter(c)) {
    SetPhases({Resting("coming to rest", c.rules.heap)}, 0);
  }

  static Vessel VesselOf(const Case& c) {
    const FunnelHeapOptions& options = c.rig.funnel_heap;
    const double diameter = options.plate_diameter;
    engine::FillRegion region;
    region.diameter = diameter;
    return {
        .region = region,
        .area = region.Area(),
        .across = diameter,
        .funnel =
            Funnel{.height = options.height, .outlet = options.outlet, .follows = options.follows},
        .is_prism = false};
  }

  static std::vector<engine::Wall> Walls(const Case& c, double) {
    const FunnelHeapOptions& options = c.rig.funnel_heap;
    const double radius = options.plate_diameter / 2;
    std::vector<engine::Wall> walls{{.name = "plate",
                                     .shape = engine::SolidCylinder{.base = {0, 0, -kThickness},
                                                                    .radius = radius,
                                                                    .length = kThickness},
                                     .material = kFloor}};
    if (options.rim_height > 0) {
      walls.push_back(
          {.name = "rim",
           .shape = engine::OpenCylinder{.radius = radius, .length = options.rim_height},
           .material = kWalls});
    }
    return walls;
  }

  static void Validate(const Case& c, base::Problems& problems) {
    problems.Require(c.filling.kind == FillingKind::kPour, "filling.kind",
                     "must be \"pour\": the heap is poured");
    problems.Require(!c.filling.taps, "filling.taps", "are not of this rig: remove them");
    problems.Require(!c.filling.drop_height, "filling.drop_height",
                     "is not of this rig: rig.height is the funnel's");
    problems.Require(!c.filling.mouth_diameter, "filling.mouth_diameter",
                     "is not of this rig: rig.outlet is the funnel's");
    problems.Require(c.rig.funnel_heap.outlet > 3 * LargestDiameter(c), "rig.outlet",
                     c.rig.funnel_heap.outlet, "must be above three (scaled) grain diameters");
  }

  static double Width(const Case& c) { return c.rig.funnel_heap.plate_diameter; }

  static double TestTime(const Case&, double) { return kRestTime; }  // the test is its filling

  // What lies on the plate or is about to land there, the layer below the rim's top included.
  std::vector<engine::Particle> Grains() const override {
    std::vector<engine::Particle> heap =
        HeapOn(simulation(), kFunnelPlate, rig_case().rig.funnel_heap.plate_diameter / 2);
    // Others cling to the plate from below.
    std::erase_if(heap, [](const engine::Particle& p) { return !(p.position.z > 0); });
    for (engine::Particle& p : heap) p.position.z -= HeapBase(rig_case());
    return heap;
  }

 protected:
  // From the first grain on some fall over the rim.
  std::optional<PhaseEnd> Look() override {
    const auto leaves = [&](const engine::Particle& p) {
      return p.position.z + p.radius < leave_height_;
    };
    WeighOut(leaves, memory().mass_fallen);
    return std::nullopt;
  }

  std::vector<Reading> Readings(GrainSpan heap) const override {
    const double falling = MassOf(simulation().Particles()) - MassOf(heap);
    std::vector<Reading> all{{Observable::kMassOnPlate, MassOf(heap)},
                             {Observable::kMassFallen, memory().mass_fallen + falling},
                             {Observable::kHeight, TopOf(heap)}};
    for (Reading& angle :
         ReposeReadings(heap, {.diameter = rig_case().rig.funnel_heap.plate_diameter,
                              .grain_diameter = MeanDiameter()})) {
      all.push_back(std::move(angle));
    }
    return all;
  }

 private:
  double leave_height_ = 0;  // below which grains leave the scene [m]
};

}  // namespace

const RigEntry kFunnelHeapRig = EntryFor<FunnelHeapRig>(RigKind::kFunnelHeap);

}  // namespace talus::rigs
