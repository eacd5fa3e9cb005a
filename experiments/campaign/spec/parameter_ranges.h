// Which properties of the powder, the plate and the tube a campaign searches, and where.
#pragma once

#include <limits>
#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "engine/laws/material.h"
#include "experiments/rigs/case/case.h"
#include "optimizer/space/parameter_space.h"

namespace talus::campaign {

template <base::Dimension kDimension>
struct ParameterRange {
  double min = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
  optimizer::Scale scale = optimizer::Scale::kLinear;
  std::optional<double> guess{};
  std::optional<double> fixed{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("min", self.min, {.dimension = kDimension, .doc = "smallest value; needed unless fixed"});
    visit("max", self.max,
          {.dimension = kDimension, .doc = "largest value, > min; needed unless fixed"});
    visit("scale", self.scale, {.doc = "log spreads trials evenly over decades; needs min > 0"});
    visit("guess", self.guess,
          {.dimension = kDimension, .doc = "a value thought to be good, tried first"});
    visit("fixed", self.fixed,
          {.dimension = kDimension, .doc = "holds it at this value, without a search"});
  }
};

// Properties of engine::Material by their names there, with plate_ or tube_ before it those of a
// wall, with plate_pair_ or tube_pair_ those that powder and wall state as a pair. The walls follow
// the powder where neither a range nor the device says otherwise.
struct ParameterRanges {
  using Number = ParameterRange<base::Dimension::kNone>;
  using SurfaceEnergy = ParameterRange<base::Dimension::kSurfaceEnergy>;

  std::optional<Number> sliding_friction{};
  std::optional<Number> rolling_friction{};
  std::optional<SurfaceEnergy> surface_energy{};
  std::optional<Number> restitution{};
  std::optional<Number> rolling_damping{};
  std::optional<ParameterRange<base::Dimension::kPressure>> youngs_modulus{};
  std::optional<Number> poisson_ratio{};
  std::optional<ParameterRange<base::Dimension::kEnergy>> hamaker_constant{};
  std::optional<ParameterRange<base::Dimension::kDensity>> density{};
  std::optional<Number> plate_sliding_friction{};
  std::optional<Number> plate_rolling_friction{};
  std::optional<SurfaceEnergy> plate_surface_energy{};
  std::optional<Number> tube_sliding_friction{};
  std::optional<Number> tube_rolling_friction{};
  std::optional<SurfaceEnergy> tube_surface_energy{};
  std::optional<Number> plate_pair_sliding_friction{};
  std::optional<Number> plate_pair_rolling_friction{};
  std::optional<Number> plate_pair_restitution{};
  std::optional<Number> tube_pair_sliding_friction{};
  std::optional<Number> tube_pair_rolling_friction{};
  std::optional<Number> tube_pair_restitution{};
  std::optional<Number> fill{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("sliding_friction", self.sliding_friction, {.doc = "mu_t"});
    visit("rolling_friction", self.rolling_friction, {.doc = "mu_r"});
    visit("surface_energy", self.surface_energy, {.doc = "gamma of one surface"});
    visit("restitution", self.restitution, {.doc = "e"});
    visit("rolling_damping", self.rolling_damping, {.doc = "eta_r of the EPSD model"});
    visit("youngs_modulus", self.youngs_modulus, {.doc = "Y"});
    visit("poisson_ratio", self.poisson_ratio, {.doc = "nu"});
    visit("hamaker_constant", self.hamaker_constant, {.doc = "A of the DMT model"});
    visit("density", self.density, {.doc = "rho"});
    visit("plate_sliding_friction", self.plate_sliding_friction, {.doc = "mu_t of the plate"});
    visit("plate_rolling_friction", self.plate_rolling_friction, {.doc = "mu_r of the plate"});
    visit("plate_surface_energy", self.plate_surface_energy,
          {.doc = "gamma of the plate, not coarse-grained"});
    visit("tube_sliding_friction", self.tube_sliding_friction, {.doc = "mu_t of the tube"});
    visit("tube_rolling_friction", self.tube_rolling_friction, {.doc = "mu_r of the tube"});
    visit("tube_surface_energy", self.tube_surface_energy,
          {.doc = "gamma of the tube, not coarse-grained"});
    visit("plate_pair_sliding_friction", self.plate_pair_sliding_friction,
          {.doc = "mu_t between powder and plate"});
    visit("plate_pair_rolling_friction", self.plate_pair_rolling_friction,
          {.doc = "mu_r between powder and plate"});
    visit("plate_pair_restitution", self.plate_pair_restitution,
          {.doc = "e between powder and plate"});
    visit("tube_pair_sliding_friction", self.tube_pair_sliding_friction,
          {.doc = "mu_t between powder and tube"});
    visit("tube_pair_rolling_friction", self.tube_pair_rolling_friction,
          {.doc = "mu_r between powder and tube"});
    visit("tube_pair_restitution", self.tube_pair_restitution,
          {.doc = "e between powder and tube"});
    visit("fill", self.fill, {.doc = "of a drum, in place of its mass: rig.fill"});
  }
};

// μ_t and μ_r in 0.001–0.7, and with adhesion γ in 1e-6–40e-5 J/m² on a log scale.
ParameterRanges UsualRanges(engine::Adhesion adhesion);

// The same as the optimiser sees it, in the order of the list above.
optimizer::ParameterSpace MakeSpace(const ParameterRanges& ranges);

// SI unit of a parameter, "" if none.
std::string UnitOf(const std::string& parameter);

// A parameter's value from a text with its unit, or a bare number in SI; throws ConfigError.
double ParseProperty(const std::string& parameter, const std::string& text);

// What a parameter's name means: "plate_pair_sliding_friction" is the sliding friction of the pair
// of powder and plate, "plate_sliding_friction" the plate's own.
struct ParameterPlace {
  int body = 0;  // index of its material (rigs/case/materials.h)
  bool is_pair = false;
  std::string property{};  // of engine::Material
};
ParameterPlace PlaceOf(const std::string& parameter);

// Sets a parameter by its name above: the powder's, a wall's or a pair's, or a drum's fill, from
// which Case::SetMassByFill makes the mass.
void SetParameter(rigs::Case& rig_case, const std::string& parameter, double value);

// What is wrong with a range, or with the powder at one of its ends, under the range's name.
void ValidateRanges(const ParameterRanges& ranges, const engine::Material& material,
                    base::Problems& problems);

}  // namespace talus::campaign
