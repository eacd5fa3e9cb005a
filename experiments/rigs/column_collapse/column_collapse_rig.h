// How far a column runs out. x is along the channel, its origin in the middle of the column.
//
//   runout = x of the farthest grains - L/2     all but 1 % of the mass lies nearer

#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/phased/phased_rig.h"

namespace talus::rigs {

class ColumnCollapseRig : public PhasedRig {
 public:
  static constexpr const char* kObservables[] = {"runout_m", "height_m", "angle_deg",
                                                 "column_height_m", "aspect_ratio"};

  explicit ColumnCollapseRig(const HeapCase& heap_case);
  ColumnCollapseRig(const HeapCase& heap_case, const PhasedState& state,
                    engine::Simulation simulation);

  static Vessel VesselOf(const HeapCase& heap_case);
  static void Validate(const HeapCase& heap_case, base::Problems& problems);
  static double Width(const HeapCase& heap_case);
  static double TestTime(const HeapCase& heap_case, double filled_height);

  std::vector<Observable> Observables() const override;

 private:
  void Plan();
  void Open();
};

}  // namespace talus::rigs
