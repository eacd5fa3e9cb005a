// How far a stress presses the grains of a bed into each other.
//
// Under a stress σ a bed of solid fraction φ whose grains have Z contacts carries in each, on
// average [rumpf1958],
//
//   F = π d² σ/(φ Z)        with Hertz, F = (4/3) Y* √(R/2) δ^(3/2):
//   δ/R = (3 √2 π σ/(φ Z Y*))^(2/3)
//
// φ = 0.58 and Z = 4.5, as frictional grains have them that are sheared. The chains of contacts
// that carry most overlap three to four times as far.
#pragma once

#include "engine/laws/pair_constants.h"

namespace talus::engine {

// Mean δ/R [-] between like grains under a stress [Pa].
double PressedOverlap(const PairConstants& pair, double stress);

// The stress [Pa] at the bottom of a bed as high as it is wide: of grains of this density [kg/m³]
// under gravity [m/s²], of this volume of solid [m³].
double BedStress(double density, double gravity, double solid_volume);

// The stress [Pa] that would press like grains of this radius [m] as their adhesion does (A1).
double AdhesiveStress(const PairConstants& pair, double radius);

}  // namespace talus::engine
