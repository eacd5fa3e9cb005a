#include "experiments/rigs/tapped_density/tapped_density_rig.h"

#include <utility>

namespace talus::rigs {
namespace {

std::vector<engine::Wall> Walls(const HeapCase& c, double height) {
  const double radius = c.rig->tapped_density.diameter / 2;
  return {{.name = "cylinder",
           .shape = engine::OpenCylinder{.base = {}, .radius = radius, .length = 1.2 * height},
           .material = kWalls},
          {.name = "floor", .shape = engine::Plane{}, .material = kFloor}};
}

}  // namespace

TappedDensityRig::TappedDensityRig(const HeapCase& c)
    : PhasedRig(c, VesselOf(c), [&c](double height) { return Walls(c, height); }) {
  Plan();
}

TappedDensityRig::TappedDensityRig(const HeapCase& c, const PhasedState& state,
                                   engine::Simulation simulation)
    : PhasedRig(c, VesselOf(c), state, std::move(simulation)) {
  Plan();
}

void TappedDensityRig::Plan() {
  Phase settling = Settling();
  settling.end = [this] { memory().numbers = {BedNow().solid_fraction}; };
  SetPhases({Tapping(heap_case().rig->tapped_density.taps), settling});
}

Vessel TappedDensityRig::VesselOf(const HeapCase& c) {
  const double diameter = c.rig->tapped_density.diameter;
  engine::FillRegion region;
  region.diameter = diameter;
  return {.region = region, .area = region.Area(), .across = diameter};
}

void TappedDensityRig::Validate(const HeapCase& c, base::Problems& problems) {
  problems.Require(!c.filling.taps, "filling.taps",
                   "are not of this rig: rig.taps are, and the density is measured before and "
                   "after them");
}

double TappedDensityRig::Width(const HeapCase& c) { return c.rig->tapped_density.diameter; }

double TappedDensityRig::TestTime(const HeapCase& c, double) {
  const TapRule& taps = c.rig->tapped_density.taps;
  return taps.count * taps.interval;
}

std::vector<Observable> TappedDensityRig::Observables() const {
  const double grain = heap_case().powder.material.density;
  const double poured = state().bed.solid_fraction;
  const double tapped = state().numbers.at(0);
  return {{.name = "poured_density_kg_per_m3", .value = grain * poured},
          {.name = "tapped_density_kg_per_m3", .value = grain * tapped},
          {.name = "hausner_ratio", .value = tapped / poured},
          {.name = "tapped_solid_fraction", .value = tapped}};
}

}  // namespace talus::rigs
