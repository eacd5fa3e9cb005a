// What a test does to its powder while it flows: how fast and under which pressure it is sheared.
//
//   I = γ̇ d √(ρ/P)                                          inertial number [gdrmidi2004]
//   γ̇ = √(2 D:D),  D = sym(L) − tr(L)/3,  L = least squares of the grains' v over their x, in a
//   cell P = −Σ F·(xⱼ − xᵢ) / (3 V),  V = Σ grains' volume / φ      mean stress of the contacts
//   [dacruz2005]
//
// d mean diameter of the simulated grains, ρ their density, φ = 0.6; cells are cubes of 4 d with 8
// grains or more that touch one other at least on average: what flies has no pressure. A cell
// counts with the power γ̇ P V that its shearing takes: a bed that only lies there does not count.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/field.h"
#include "engine/simulation.h"

namespace talus::rigs {

// Weights over logarithmic bins.
struct LogHistogram {
  std::vector<double> weights{};  // of an eighth of a decade each, from 1e-12 on; those before last

  void Add(double value, double weight);
  double Quantile(double share) const;  // NaN while it is empty

  TALUS_FIELDS(weights);
};

// What has been seen so far; part of a checkpoint.
struct RegimeMemory {
  int num_looks = 0;
  LogHistogram inertial_number{};
  LogHistogram pressure{};    // [Pa]
  LogHistogram shear_rate{};  // [1/s]

  static constexpr base::FieldKey kKeys[] = {{"pressure", "pressure_Pa"},
                                             {"shear_rate", "shear_rate_per_s"}};
  TALUS_FIELDS(num_looks, inertial_number, pressure, shear_rate);
};

// The grains as they are at a look, by id, and their contacts.
struct FlowingGrains {
  std::span<const engine::Particle> particles;
  std::span<const engine::ContactInfo> contacts;
  double diameter = 0;  // d [m]
  double density = 0;   // ρ [kg/m³]
};
void LookAtFlow(const FlowingGrains& grains, RegimeMemory& memory);

// 5, 50 and 95 % of the work of shearing is done below these.
using RegimeRange = std::array<double, 3>;

struct Regime {
  RegimeRange inertial_number{};
  RegimeRange pressure{};    // [Pa]
  RegimeRange shear_rate{};  // [1/s]
};
// None where nothing was sheared.
std::optional<Regime> RegimeOf(const RegimeMemory& memory);

}  // namespace talus::rigs
