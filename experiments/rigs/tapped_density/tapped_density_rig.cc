// How densely a powder lies in a cylinder, poured and tapped.
//
//   ρ = m / (A h)     h = 2 (height of the centre of mass above the floor), the level of an even
//   bed
#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text/number_text.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/filling/pouring.h"
#include "experiments/rigs/phased/pace.h"
#include "experiments/rigs/phased/rig_entry.h"

namespace talus::rigs {
namespace {

struct TappedDensityMemory {
  double solid_fraction = 0;  // after the taps [-]

  TALUS_FIELDS(solid_fraction);
};

class TappedDensityRig : public RememberingRig<TappedDensityMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kPouredDensity},
                                                {Observable::kTappedDensity, true},
                                                {Observable::kHausnerRatio},
                                                {Observable::kTappedSolidFraction}};

  TappedDensityRig(const Case& c, State state, engine::Simulation simulation)
      : RememberingRig(c, VesselOf(c), std::move(state), std::move(simulation)) {
    Phase settling = Resting("settling", c.rules.settling);
    settling.end = [this] { MeasureTapped(); };
    SetPhases({Tapping(c.rig.tapped_density.taps), settling},
              TestTime(c, FilledHeight(c, vessel())));
  }

  static Vessel VesselOf(const Case& c) {
    const double diameter = c.rig.tapped_density.diameter;
    engine::FillRegion region;
    region.diameter = diameter;
    return {.region = region, .area = region.Area(), .across = diameter};
  }

  static std::vector<engine::Wall> Walls(const Case& c, double height) {
    const double radius = c.rig.tapped_density.diameter / 2;
    const double headroom = Headroom(c, VesselOf(c), c.rig.tapped_density.taps);
    return {{.name = "cylinder",
             .shape = engine::OpenCylinder{.base = {},
                                           .radius = radius,
                                           .length = std::max(1.2 * height, height + headroom)},
             .material = kWalls},
            {.name = "floor", .shape = engine::Plane{}, .material = kFloor}};
  }

  static void Validate(const Case& c, base::Problems& problems) {
    problems.Require(!c.filling.taps, "filling.taps",
                     "are not of this rig: rig.taps are, and the density is measured before and "
                     "after them");
  }

  static double Width(const Case& c) { return c.rig.tapped_density.diameter; }

  static double TestTime(const Case& c, double) {
    const TapRule& taps = c.rig.tapped_density.taps;
    return taps.count * taps.interval + kRestTime;
  }

 protected:
  std::vector<Reading> Readings(GrainSpan) const override {
    const double grain = rig_case().powder.material.density;
    const double poured = state().bed.solid_fraction;
    const double tapped = memory().solid_fraction;
    return {{Observable::kPouredDensity, grain * poured},
            {Observable::kTappedDensity, grain * tapped},
            {Observable::kHausnerRatio, tapped / poured},
            {Observable::kTappedSolidFraction, tapped}};
  }

 private:
  // Beds of equal spheres reach 0.64 and no packing of them more than 0.74; those of several sizes
  // little more.
  void MeasureTapped() {
    constexpr double kDensest = 0.8;
    memory().solid_fraction = BedNow().solid_fraction;
    if (memory().solid_fraction <= kDensest) return;
    throw base::Error("the grains are pressed into each other: a solid fraction of " +
                      base::ShortNumber(memory().solid_fraction) + " after the taps, above the " +
                      base::ShortNumber(kDensest) +
                      " that powders reach; lower taps.height or raise youngs_modulus");
  }
};

}  // namespace

const RigEntry kTappedDensityRig = EntryFor<TappedDensityRig>(RigKind::kTappedDensity);

}  // namespace talus::rigs
