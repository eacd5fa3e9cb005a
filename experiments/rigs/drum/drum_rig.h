// The dynamic angle of repose in a turning drum: the mean slope of the middle half of the surface,
// over a given number of turns. The axis is y, the drum's lowest point z = 0; it carries the grains
// towards -x. Front and back are of the floor's material where there is one, else of the side's.
#pragma once

#include <optional>
#include <vector>

#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

struct DrumMemory {
  std::vector<double> angles{};  // of the surface at each look [deg]

  static constexpr base::FieldKey kKeys[] = {{"angles", "angles_deg"}};
  TALUS_FIELDS(angles);
};

class DrumRig : public RememberingRig<DrumMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {
      {Observable::kAngle, true}, {Observable::kAngleSd}, {Observable::kCohesiveIndex}};

  DrumRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

 protected:
  std::optional<PhaseEnd> Look() override;
  std::vector<Reading> Readings(GrainSpan grains) const override;

 private:
  void Turn();
};

}  // namespace talus::rigs
