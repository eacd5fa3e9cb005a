// How fast a powder runs through a slot, how much stays above, and the slopes that it leaves above
// and below. x is across the slot, its origin in the slot's middle; z = 0 is the lower floor.

#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/phased/phased_rig.h"

namespace talus::rigs {

class DrawDownRig : public PhasedRig {
 public:
  static constexpr const char* kObservables[] = {"mass_fallen_kg",   "mass_left_kg",
                                                 "discharge_time_s", "discharge_rate_kg_per_s",
                                                 "angle_deg",        "shear_angle_deg"};

  explicit DrawDownRig(const HeapCase& heap_case);
  DrawDownRig(const HeapCase& heap_case, const PhasedState& state, engine::Simulation simulation);

  static Vessel VesselOf(const HeapCase& heap_case);
  static void Validate(const HeapCase& heap_case, base::Problems& problems);
  static double Width(const HeapCase& heap_case);
  static double TestTime(const HeapCase& heap_case, double filled_height);

  std::vector<Observable> Observables() const override;

 protected:
  bool Look() override;

 private:
  void Plan();
  double Passed() const;  // mass below the slot [kg]
};

}  // namespace talus::rigs
