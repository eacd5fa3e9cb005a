// How fast a powder runs through a round orifice, and whether it does: a cylinder with a flat floor
// or a cone. z = 0 is the orifice. It flows where more than a tenth of the powder runs out before
// an arch stands; else the rate is 0.

#pragma once

#include <optional>
#include <vector>

#include "experiments/rigs/phased/flow.h"
#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

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

  OrificeFlowRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

 protected:
  std::optional<PhaseEnd> Look() override;
  std::vector<Reading> Readings(GrainSpan grains) const override;

 private:
  double MassBelow(GrainSpan grains) const;  // the orifice, or gone [kg]

  double leave_height_ = 0;  // below which grains leave the scene [m]
};

}  // namespace talus::rigs
