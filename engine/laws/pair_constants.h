// What the contact laws need of two materials: equations P3–P7 of docs/physics.md with all factors
// that do not change from contact to contact multiplied in.
#pragma once

#include "engine/scene/material.h"

namespace talus::engine {

struct PairConstants {
  double y_star = 0;              // Y* [Pa] (P3)
  double normal_stiffness = 0;    // k_n / s = (4/3) Y* [Pa] (N1)
  double shear_stiffness = 0;     // k_t / s = 8 G* [Pa] (N1)
  double normal_damping = 0;      // η_n / √(s m*) = 2√(5/6) β √(2Y*) [√Pa] (N3)
  double tangential_damping = 0;  // η_t / √(s m*) = 2√(5/6) β √(8G*) [√Pa] (N4)
  double sliding_friction = 0;    // μ_t [-] (P5)
  double rolling_friction = 0;    // μ_r [-] (P5)
  double rolling_stiffness = 0;   // k_r / (s R*²) = 2.25 (4/3) Y* μ_r² [Pa] (R1)
  double rolling_damping = 0;     // C_r / (R* √(s I*)) = 2 η_r √rolling_stiffness [√Pa] (R3)
  double mobilised_damping = 0;   // f [-] (R4)
  double surface_energy = 0;      // γ* [J/m²] (P6)
  double pull_off = 0;            // F_po / R* = 2π γ* [N/m] (A1)
  double jkr_cube_root = 0;       // ∛(2πγ*/Y*) [m^⅓] (A4)
  double rolling_pull_off = 0;    // added to F_n / R* in JKR's rolling limit [N/m] (A6)
  bool keeps_spring = false;      // a sliding spring is not shortened (A7); never against a wall
  double hamaker = 0;             // A/6 [J] (A3), zero without adhesion
  double plateau_gap = 0;         // -δ₀ [m] (A2): up to this gap the pull is F_po
  double adhesion_gap = 0;        // -δ_c [m] (A2): beyond this gap there is none; 0 without DMT
};

// β of (N2).
double DampingRatio(double restitution);

// Harmonic mean 2ab/(a+b), zero if either is zero (P5).
double HarmonicMean(double a, double b);

PairConstants MakePairConstants(const Material& a, const Material& b, const ContactModels& models);

}  // namespace talus::engine
