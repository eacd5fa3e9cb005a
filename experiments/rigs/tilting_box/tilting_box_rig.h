// The angle at which the load of a tilted box slides: gravity turns, which to the grains is the
// same as long as it is slow. x points down the slope. It has slid when its centre of mass has
// moved half a grain along it.

#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/phased/phased_rig.h"

namespace talus::rigs {

class TiltingBoxRig : public PhasedRig {
 public:
  static constexpr const char* kObservables[] = {"angle_deg", "mass_left_kg"};

  explicit TiltingBoxRig(const HeapCase& heap_case);
  TiltingBoxRig(const HeapCase& heap_case, const PhasedState& state, engine::Simulation simulation);

  static Vessel VesselOf(const HeapCase& heap_case);
  static void Validate(const HeapCase& heap_case, base::Problems& problems);
  static double Width(const HeapCase& heap_case);
  static double TestTime(const HeapCase& heap_case, double filled_height);

  std::vector<Observable> Observables() const override;

 protected:
  bool Look() override;

 private:
  void Plan();
  void Tilt();
  double Centre() const;  // of all grains along x, those that have left at the lip [m]
};

}  // namespace talus::rigs
