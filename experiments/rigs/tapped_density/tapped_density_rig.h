// How densely a powder lies in a cylinder, poured and tapped.
//
//   ρ = m / (A h)     h = 2 (height of the centre of mass above the floor), the level of an even
//   bed
#pragma once

#include <vector>

#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

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

  TappedDensityRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

 protected:
  std::vector<Reading> Readings(GrainSpan grains) const override;

 private:
  void MeasureTapped();
};

}  // namespace talus::rigs
