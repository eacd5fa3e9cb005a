// The straight line through the shear stresses of a powder at several normal stresses, after Mohr
// and Coulomb:
//
//   τ = c + σ tan φ        c cohesion, φ angle of internal friction; least squares
#pragma once

#include <optional>
#include <span>

namespace talus::rigs {

struct StressPoint {
  double normal = 0;  // σ [Pa]
  double shear = 0;   // τ [Pa]
};

struct YieldLine {
  double cohesion = 0;  // c [Pa]; below zero where the points say so
  double slope = 0;     // tan φ [-]
};

// Nothing for fewer than two normal stresses.
std::optional<YieldLine> YieldLineOf(std::span<const StressPoint> points);

}  // namespace talus::rigs
