// How densely a powder lies in a cylinder, poured and tapped.
//
//   ρ = m / (A h)     h = 2 (height of the centre of mass above the floor), the level of an even
//   bed

#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/phased/phased_rig.h"

namespace talus::rigs {

class TappedDensityRig : public PhasedRig {
 public:
  static constexpr const char* kObservables[] = {"poured_density_kg_per_m3",
                                                 "tapped_density_kg_per_m3", "hausner_ratio",
                                                 "tapped_solid_fraction"};

  explicit TappedDensityRig(const HeapCase& heap_case);
  TappedDensityRig(const HeapCase& heap_case, const PhasedState& state,
                   engine::Simulation simulation);

  static Vessel VesselOf(const HeapCase& heap_case);
  static void Validate(const HeapCase& heap_case, base::Problems& problems);
  static double Width(const HeapCase& heap_case);
  static double TestTime(const HeapCase& heap_case, double filled_height);

  std::vector<Observable> Observables() const override;

 private:
  void Plan();
};

}  // namespace talus::rigs
