// The heap that powder makes when it runs out of a funnel at a fixed height onto a plate, with a
// rim or without. The plate's top is z = 0.

#pragma once

#include <optional>
#include <vector>

#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

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

  FunnelHeapRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

  std::vector<engine::Particle> Grains() const override;  // what has not fallen off the plate

 protected:
  std::optional<PhaseEnd> Look() override;
  std::vector<Reading> Readings(GrainSpan heap) const override;

 private:
  double leave_height_ = 0;  // below which grains leave the scene [m]
};

}  // namespace talus::rigs
