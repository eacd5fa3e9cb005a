// The angle at which the load of a tilted box slides: gravity turns, which to the grains is the
// same as long as it is slow. x points down the slope. It has slid when its centre of mass has
// moved half a grain along it.
#pragma once

#include <optional>
#include <vector>

#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

struct TiltingBoxMemory {
  double start_centre = 0;  // x of the centre of mass when the tilting begins [m]
  double angle = 0;         // at which the load slid; 0 before [rad]
  double mass_left = 0;     // over the lip [kg]

  static constexpr base::FieldKey kKeys[] = {
      {"start_centre", "start_centre_m"}, {"angle", "angle_rad"}, {"mass_left", "mass_left_kg"}};
  TALUS_FIELDS(start_centre, angle, mass_left);
};

class TiltingBoxRig : public RememberingRig<TiltingBoxMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kAngle, true},
                                                {Observable::kMassLeft}};

  TiltingBoxRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

 protected:
  std::optional<PhaseEnd> Look() override;
  std::vector<Reading> Readings(GrainSpan grains) const override;

 private:
  void Tilt();
  double Centre() const;  // of all grains along x, those that have left at the lip [m]
};

}  // namespace talus::rigs
