// The units that the kernels compute in.
//
// Single precision holds 10^±38. In SI units the squared forces of small grains lie outside; in
// units near a grain's size, its mass and the time step every number of a contact lies near one.
// Units are powers of two, so that going from one to the other loses nothing.
#pragma once

#include <span>

#include "engine/laws/pair_constants.h"

namespace talus::engine {

using SingleConstants = PairConstantsOf<float>;

struct Units {
  double length = 1;  // [m]
  double mass = 1;    // [kg]
  double time = 1;    // [s]

  double Speed() const { return length / time; }                  // [m/s]
  double Inertia() const { return mass * length * length; }       // [kg m²]
  double Force() const { return mass * length / (time * time); }  // [N]
  double Torque() const { return Force() * length; }              // [N m]
  double Stress() const { return Force() / (length * length); }   // [Pa]
  double SurfaceEnergy() const { return Force() / length; }       // [J/m²]
};

// For steps of Δt [s]: in the softest material an elastic wave's way in a step is about the radius
// of the smallest sphere.
Units UnitsOf(std::span<const Material> materials, double time_step);

SingleConstants ToUnits(const PairConstants& pair, const Units& units);

}  // namespace talus::engine
