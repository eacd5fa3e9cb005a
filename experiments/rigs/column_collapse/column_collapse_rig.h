// How far a column runs out. x is along the channel, its origin in the middle of the column.
//
//   runout = x of the farthest grains - L/2     all but 1 % of the mass lies nearer
#pragma once

#include <vector>

#include "experiments/rigs/phased/remembering_rig.h"

namespace talus::rigs {

class ColumnCollapseRig : public RememberingRig<NoMemory> {
 public:
  static constexpr RigObservable kMeasured[] = {{Observable::kRunout, true},
                                                {Observable::kHeight, true},
                                                {Observable::kAngle},
                                                {Observable::kColumnHeight},
                                                {Observable::kAspectRatio}};

  ColumnCollapseRig(const Case& rig_case, State state, engine::Simulation simulation);

  static Vessel VesselOf(const Case& rig_case);
  static std::vector<engine::Wall> Walls(const Case& rig_case, double height);
  static void Validate(const Case& rig_case, base::Problems& problems);
  static double Width(const Case& rig_case);
  static double TestTime(const Case& rig_case, double filled_height);

 protected:
  std::vector<Reading> Readings(GrainSpan grains) const override;

 private:
  void Open();
};

}  // namespace talus::rigs
