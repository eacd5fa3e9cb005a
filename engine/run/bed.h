// How densely a bed of grains lies: what a packed or tapped cup is judged by.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/simulation.h"

namespace talus::engine {

// A bed in an upright vessel of one cross-section.
struct Bed {
  double height = 0;          // twice that of the centre of mass above the floor [m]
  double solid_fraction = 0;  // volume of the grains over area times height [-]
  double coordination = 0;    // mean number of grains that a grain touches [-]
};

struct Vessel {
  double area = 0;                                                 // of the cross-section [m²]
  double floor = 0;                                                // height of its floor [m]
  std::int64_t end_id = std::numeric_limits<std::int64_t>::max();  // grains from it on: others'
};

// For a level bed of even density the height is that of its surface. Grains below the floor have
// fallen out and do not count.
Bed MeasureBed(const Simulation& simulation, const Vessel& vessel);

}  // namespace talus::engine
