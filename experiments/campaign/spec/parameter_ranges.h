// Which properties of the powder, the plate and the tube a campaign searches, where, and what is
// known of them beforehand.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/field.h"
#include "base/not_known.h"
#include "base/problems.h"
#include "engine/laws/material.h"
#include "experiments/campaign/spec/parameter_prior.h"
#include "experiments/rigs/case/case.h"
#include "optimizer/space/parameter_space.h"

namespace talus::campaign {

template <base::Dimension kDimension>
struct ParameterRange {
  double min = base::kNotKnown;
  double max = base::kNotKnown;
  optimizer::Scale scale = optimizer::Scale::kLinear;
  std::optional<double> guess{};
  std::optional<double> fixed{};
  std::optional<ParameterPrior<kDimension>> prior{};  // default: uniform on its scale
  bool nuisance = false;  // searched because nobody knows it, not because it is asked for
  std::optional<double> added_at{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit(
        "min", self.min,
        {.dimension = kDimension, .doc = "smallest value; needed unless fixed", .unit_of = "max"});
    visit("max", self.max,
          {.dimension = kDimension,
           .doc = "largest value, > min; needed unless fixed",
           .unit_of = "min"});
    visit("scale", self.scale, {.doc = "log spreads trials evenly over decades; needs min > 0"});
    visit("guess", self.guess,
          {.dimension = kDimension,
           .doc = "a value thought to be good, tried first",
           .unit_of = "max"});
    visit("fixed", self.fixed,
          {.dimension = kDimension, .doc = "holds it at this value, without a search"});
    visit("prior", self.prior,
          {.doc = "what is known of it beforehand; default: nothing but its range"});
    visit("nuisance", self.nuisance,
          {.doc = "not asked for: searched with its prior, and the ranges of the others include "
                  "what it leaves open"});
    visit("added_at", self.added_at,
          {.dimension = kDimension,
           .doc = "filled in by `talus resume --search`: the value of the trials before it"});
  }
};

// Properties of engine::Material by their names there, with plate_ or tube_ before it those of a
// wall, with plate_pair_ or tube_pair_ those that powder and wall state as a pair; and quantities
// of the bulk. The walls follow the powder where neither a range nor the device says otherwise.
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
  std::optional<ParameterRange<base::Dimension::kMass>> mass{};
  std::optional<Number> fill{};           // of a drum (rig.fill); its mass follows
  std::optional<Number> particle_size{};  // factor on every diameter of powder.sizes
  std::optional<EarlierPosterior> prior{};

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
          {.doc = "gamma of the plate, of true grains"});
    visit("tube_sliding_friction", self.tube_sliding_friction, {.doc = "mu_t of the tube"});
    visit("tube_rolling_friction", self.tube_rolling_friction, {.doc = "mu_r of the tube"});
    visit("tube_surface_energy", self.tube_surface_energy,
          {.doc = "gamma of the tube, of true grains"});
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
    visit("mass", self.mass, {.doc = "filled, in place of powder.mass"});
    visit("fill", self.fill, {.doc = "of a drum, in place of its mass: rig.fill"});
    visit("particle_size", self.particle_size, {.doc = "factor on every diameter of powder.sizes"});
    visit("prior", self.prior,
          {.doc = "of all these parameters together: the posterior of an earlier campaign"});
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

// Sets a parameter by its name above: the powder's, a wall's, a pair's or the bulk's. A drum's
// fill becomes its mass (Case::SetMassByFill). Where a parameter has nothing to say (`fill` without
// a drum) it changes nothing.
void SetParameter(rigs::Case& rig_case, const std::string& parameter, double value);

// The value that a case has of it; nothing where it says nothing of it, or states no such pair. A
// wall without a property of its own has the powder's.
std::optional<double> ParameterOf(const rigs::Case& rig_case, const std::string& parameter);

// The value that all trials have of one that is not searched: its own `fixed`, else the case's.
std::optional<double> HeldAt(const optimizer::ParameterSpace& space, const rigs::Case& rig_case,
                             const std::string& parameter);

// Whether it multiplies what a case has, so that SetParameter acts anew on what it has made.
bool IsFactor(const std::string& parameter);

// A tilted plate tells the friction between powder and a wall; nothing tells that of two grains.
bool CanBeMeasuredDirectly(const std::string& parameter);

// A law without which a parameter changes nothing, be it the powder's, a wall's or a pair's.
struct MissingLaw {
  std::string why;  // "has no effect without adhesion"
  std::string remedy;
};
std::optional<MissingLaw> LawMissingFor(const std::string& parameter,
                                        const engine::ContactModels& models);

// Whether it is one of the bulk, which decides whether the powder fits into its vessel.
bool IsOfBulk(const std::string& parameter);

// "0.35 ± 0.05" for each parameter that the ranges give a prior, by name.
std::map<std::string, std::string> PriorTexts(const ParameterRanges& ranges);

// What is wrong with a range, or with the powder at one of its ends, under the range's name.
void ValidateRanges(const ParameterRanges& ranges, const engine::Material& material,
                    base::Problems& problems);

}  // namespace talus::campaign
