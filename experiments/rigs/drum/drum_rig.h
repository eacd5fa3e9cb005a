// The dynamic angle of repose in a turning drum: the mean slope of the middle half of the surface,
// over a given number of turns. The axis is y, the drum's lowest point z = 0; it carries the grains
// towards -x.

#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/phased/phased_rig.h"

namespace talus::rigs {

class DrumRig : public PhasedRig {
 public:
  static constexpr const char* kObservables[] = {"angle_deg", "angle_sd_deg"};

  explicit DrumRig(const HeapCase& heap_case);
  DrumRig(const HeapCase& heap_case, const PhasedState& state, engine::Simulation simulation);

  static Vessel VesselOf(const HeapCase& heap_case);
  static void Validate(const HeapCase& heap_case, base::Problems& problems);
  static double Width(const HeapCase& heap_case);
  static double TestTime(const HeapCase& heap_case, double filled_height);

  std::vector<Observable> Observables() const override;

 protected:
  bool Look() override;

 private:
  void Plan();
  void Turn();
};

}  // namespace talus::rigs
