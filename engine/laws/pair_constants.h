// What the contact laws need of two materials: equations P3–P7 of docs/physics.md with all factors
// that do not change from contact to contact multiplied in. The kernels have them in single
// precision and in units of their own (engine/laws/units.h).
#pragma once

#include "engine/laws/material.h"

namespace talus::engine {

template <class T>
struct PairConstantsOf {
  T y_star = 0;               // Y* [Pa] (P3)
  T normal_stiffness = 0;     // k_n / s = (4/3) Y* [Pa] (N1)
  T shear_stiffness = 0;      // k_t / s = 8 G* [Pa] (N1)
  T shear_compliance = 0;     // its inverse [1/Pa]
  T normal_damping = 0;       // η_n / √(s m*) = 2√(5/6) β √(2Y*) [√Pa] (N3)
  T tangential_damping = 0;   // η_t / √(s m*) = 2√(5/6) β √(8G*) [√Pa] (N4)
  T sliding_friction = 0;     // μ_t [-] (P5)
  T rolling_friction = 0;     // μ_r [-] (P5)
  T rolling_per_speed = 1;    // of the viscous rolling law: 1 s/m, in the engine's units
  T rolling_stiffness = 0;    // k_r / (s R*²) = 2.25 (4/3) Y* μ_r² [Pa] (R1)
  T rolling_damping = 0;      // C_r / (R* √(s I*)) = 2 η_r √rolling_stiffness [√Pa] (R3)
  T mobilised_damping = 0;    // f [-] (R4)
  T surface_energy = 0;       // γ* [J/m²] (P6)
  T pull_off = 0;             // F_po / R* = 2π γ* [N/m] (A1)
  T jkr_cube_root = 0;        // ∛(2πγ*/Y*) [m^⅓] (A4)
  T rolling_pull_off = 0;     // added to F_n / R* in JKR's rolling limit [N/m] (A6)
  bool keeps_spring = false;  // a sliding spring is not shortened (A7); never against a wall
  T hamaker = 0;              // A/6 [J] (A3), zero without adhesion
  T plateau_gap = 0;          // -δ₀ [m] (A2): up to this gap the pull is F_po
  T adhesion_gap = 0;         // -δ_c [m] (A2): beyond this gap there is none; 0 without DMT
};

using PairConstants = PairConstantsOf<double>;

// β of (N2).
double DampingRatio(double restitution);

// Harmonic mean 2ab/(a+b), zero if either is zero (P5).
double HarmonicMean(double a, double b);

PairConstants MakePairConstants(const Material& a, const Material& b, const ContactModels& models);

}  // namespace talus::engine
