#include "experiments/rigs/case/plausible_quantity.h"

#include <array>
#include <numbers>

#include "base/field.h"
#include "base/text/number_text.h"

namespace talus::rigs {
namespace {

using base::Dimension;

constexpr double kFastest = 5;  // part of a rig [m/s]

// The value was typed as one unit and read as another: written as `value · factor` of this one.
struct Slip {
  double factor;
  const char* unit;
};

struct Plausible {
  Dimension dimension;
  double low, high;           // SI
  std::array<Slip, 2> slips;  // the likelier first
};

const Plausible& PlausibleOf(BenchQuantity quantity) {
  // From foamed polystyrene to osmium.
  static constexpr Plausible kDensity{
      Dimension::kDensity, 25, 25e3, {{{1, "g/cm^3"}, {1e-3, "kg/m^3"}}}};
  // Below a micrometre a powder is no more a heap of separate spheres.
  static constexpr Plausible kGrain{Dimension::kLength, 1e-6, 0.05, {{{1, "mm"}, {1e6, "mm"}}}};
  static constexpr Plausible kVessel{Dimension::kLength, 5e-4, 2, {{{1, "mm"}, {1e3, "mm"}}}};
  static constexpr Plausible kVelocity{
      Dimension::kVelocity, 1e-4, kFastest, {{{1, "mm/s"}, {1e6, "mm/s"}}}};
  static constexpr Plausible kFilling{Dimension::kMass, 1e-7, 200, {{{1, "g"}, {1e3, "g"}}}};
  // Softer than any gel, stiffer than diamond.
  static constexpr Plausible kModulus{Dimension::kPressure, 1e3, 2e12, {{{1, "MPa"}, {1, "GPa"}}}};
  // A few times that of a clean metal.
  static constexpr Plausible kSurface{
      Dimension::kSurfaceEnergy, 0, 10, {{{1, "mJ/m^2"}, {1, "uJ/m^2"}}}};
  switch (quantity) {
    case BenchQuantity::kGrainDensity:
      return kDensity;
    case BenchQuantity::kGrainDiameter:
      return kGrain;
    case BenchQuantity::kTubeDiameter:
    case BenchQuantity::kPlateDiameter:
      return kVessel;
    case BenchQuantity::kLiftVelocity:
      return kVelocity;
    case BenchQuantity::kMass:
      return kFilling;
    case BenchQuantity::kYoungsModulus:
      return kModulus;
    case BenchQuantity::kSurfaceEnergy:
      return kSurface;
  }
  return kDensity;
}

bool IsWithin(const Plausible& plausible, double value) {
  return value >= plausible.low && value <= plausible.high;
}

struct RigChecker {
  const std::string& path;
  base::Problems& problems;

  void operator()(std::string_view key, double value, const base::FieldInfo& info = {}) {
    const std::string place = path + "." + std::string(key);
    const std::string number = base::ShortNumber(value);
    if (info.dimension == Dimension::kVelocity) {
      problems.Require(!(value > kFastest), place, value,
                       "in m/s, must be at most 5; write \"" + number + " mm/s\"");
    } else if (info.dimension == Dimension::kAngle) {
      problems.Require(!(value > 2 * std::numbers::pi), place, value,
                       "in rad, is more than a turn; write \"" + number + " deg\"");
    }
  }
  template <class Other>
  void operator()(std::string_view, const Other&, const base::FieldInfo& = {}) {}
};

}  // namespace

std::string ImplausibleText(BenchQuantity quantity, double value) {
  const Plausible& plausible = PlausibleOf(quantity);
  if (!(value > 0) || IsWithin(plausible, value)) return "";
  std::string text = "in " + std::string(base::SiUnit(plausible.dimension)) + ", must be ";
  text += plausible.low > 0 ? "from " + base::ShortNumber(plausible.low, 6) + " to " : "at most ";
  text += base::ShortNumber(plausible.high, 6);
  constexpr double kHopeless = 1e100;  // with a unit's factor too large for a double
  for (const Slip& slip : plausible.slips) {
    const std::string meant = base::ShortNumber(slip.factor * value) + " " + slip.unit;
    if (value > kHopeless || !IsWithin(plausible, base::ParseQuantity(meant, plausible.dimension)))
      continue;
    return text + "; write \"" + meant + "\"";
  }
  return text;
}

void RequirePlausible(BenchQuantity quantity, double value, std::string_view path,
                      base::Problems& problems) {
  const std::string text = ImplausibleText(quantity, value);
  problems.Require(text.empty(), path, value, text);
}

void RequirePlausibleTube(const LiftedTubeOptions& tube, const std::string& path,
                          base::Problems& problems) {
  RequirePlausible(BenchQuantity::kTubeDiameter, tube.tube_inner_diameter,
                   path + ".tube_inner_diameter", problems);
  RequirePlausible(BenchQuantity::kPlateDiameter, tube.plate_diameter, path + ".plate_diameter",
                   problems);
  RequirePlausible(BenchQuantity::kLiftVelocity, tube.lift_velocity, path + ".lift_velocity",
                   problems);
}

void RequirePlausibleRig(const RigOptions& rig, const std::string& path, base::Problems& problems) {
  RigChecker checker{path, problems};
  RigOptions::Visit(rig, checker);
}

std::pair<const char*, double> TypicalDiameter(const engine::SizeDistribution& sizes) {
  if (sizes.diameter) return {"diameter", *sizes.diameter};
  if (sizes.mean) return {"mean", *sizes.mean};
  if (sizes.median) return {"median", *sizes.median};
  if (sizes.max) return {"max", *sizes.max};
  return {"diameters", sizes.diameters.empty() ? 0 : sizes.diameters.back()};
}

void RequirePlausibleGrains(const Powder& powder, base::Problems& problems) {
  const engine::Material& grains = powder.material;
  const std::string material = "powder.material.";
  RequirePlausible(BenchQuantity::kGrainDensity, grains.density, material + "density", problems);
  RequirePlausible(BenchQuantity::kYoungsModulus, grains.youngs_modulus,
                   material + "youngs_modulus", problems);
  RequirePlausible(BenchQuantity::kSurfaceEnergy, grains.surface_energy,
                   material + "surface_energy", problems);
  const auto& [key, diameter] = TypicalDiameter(powder.sizes);
  RequirePlausible(BenchQuantity::kGrainDiameter, diameter, "powder.sizes." + std::string(key),
                   problems);
}

}  // namespace talus::rigs
