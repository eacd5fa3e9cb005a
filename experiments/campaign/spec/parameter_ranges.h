// Which of the powder's properties a campaign searches, and where.
#pragma once

#include <limits>
#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "engine/scene/material.h"
#include "optimizer/space/parameter_space.h"

namespace talus::experiments {

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

// Properties of engine::Material by their names there. The walls follow the powder's, where the
// device does not say otherwise.
struct ParameterRanges {
  using Number = ParameterRange<base::Dimension::kNone>;

  std::optional<Number> sliding_friction{};
  std::optional<Number> rolling_friction{};
  std::optional<ParameterRange<base::Dimension::kSurfaceEnergy>> surface_energy{};
  std::optional<Number> restitution{};
  std::optional<Number> rolling_damping{};
  std::optional<ParameterRange<base::Dimension::kPressure>> youngs_modulus{};
  std::optional<Number> poisson_ratio{};
  std::optional<ParameterRange<base::Dimension::kEnergy>> hamaker_constant{};
  std::optional<ParameterRange<base::Dimension::kDensity>> density{};

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
  }
};

// μ_t and μ_r in 0.001–0.7, and with adhesion γ in 1e-6–40e-5 J/m² on a log scale.
ParameterRanges UsualRanges(engine::Adhesion adhesion);

// The same as the optimiser sees it, in the order of the list above.
optimizer::ParameterSpace MakeSpace(const ParameterRanges& ranges);

// SI unit of a property of engine::Material, "" if none.
std::string UnitOf(const std::string& property);

// A property's value from a text with its unit, or a bare number in SI; throws ConfigError.
double ParseProperty(const std::string& property, const std::string& text);

// Sets a property by its name in engine::Material.
void SetProperty(engine::Material& material, const std::string& property, double value);

// What is wrong with a range, or with the powder at one of its ends, under the range's name.
void ValidateRanges(const ParameterRanges& ranges, const engine::Material& material,
                    base::Problems& problems);

}  // namespace talus::experiments
