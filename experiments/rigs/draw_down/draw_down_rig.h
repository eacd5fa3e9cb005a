// How fast a powder runs through a slot, how much stays above, and the slopes that it leaves above
// and below. x is across the slot, its origin in the slot's middle; z = 0 is the lower floor.
#pragma once

#include <optional>
#include <vector>

#include "experiments/rigs/phased/flow.h"
#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

class DrawDownRig : public RememberingRig<FlowMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {
      {Observable::kMassFallen},          {Observable::kMassLeft, true},
      {Observable::kDischargeTime, true}, {Observable::kDischargeRate},
      {Observable::kAngle, true},         {Observable::kShearAngle}};

  DrawDownRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

 protected:
  std::optional<PhaseEnd> Look() override;
  std::vector<Reading> Readings(GrainSpan grains) const override;

 private:
  double MassBelow(GrainSpan grains) const;  // the slot [kg]
};

}  // namespace talus::rigs
