// The angle at which the load of a tilted box slides: gravity turns, which to the grains is the
// same as long as it is slow. x points down the slope. It has slid when its centre of mass has
// moved half a grain along it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

struct TiltingBoxMemory {
  double start_centre = 0;  // x of the centre of mass when the tilting begins [m]
  double angle = 0;         // at which the load slid; 0 before [rad]
  double mass_left = 0;     // over the lip [kg]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("start_centre_m", self.start_centre);
    visit("angle_rad", self.angle);
    visit("mass_left_kg", self.mass_left);
  }
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
