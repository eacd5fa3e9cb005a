#include "experiments/campaign/spec/plausible.h"

#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/number_text.h"

namespace talus::campaign {
namespace {

using rigs::Observable;

constexpr double kSolidFraction = 0.6;              // of a filled tube, roughly [-]
constexpr double kMostDiameters = 50;               // height of the filling / tube diameter
constexpr double kFastestLift = 5;                  // [m/s]
constexpr double kSteepest = std::numbers::pi / 2;  // [rad]
constexpr double kLargestAngleError = 0.5;          // [rad]
constexpr double kLooseFill = 1.02;                 // of the mass filled: a balance is that good
constexpr double kLargestHausner = 3;

// One experiment's keys, to name them in problems.
class Place {
 public:
  explicit Place(std::string prefix) : prefix_(std::move(prefix)) {}
  std::string operator()(std::string_view key) const {
    return prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key);
  }

 private:
  std::string prefix_;
};

// A bare number of degrees, read as radians.
void CheckAngle(const std::optional<MeasuredNumber<base::Dimension::kAngle>>& angle,
                const std::string& place, base::Problems& problems) {
  if (!angle) return;
  const auto check = [&](const char* key, double value, double most) {
    const std::string number = base::ShortNumber(value);
    problems.Require(value <= most, place + "." + key, value,
                     "in rad, which is " + base::ShortNumber(value * 180 / std::numbers::pi) +
                         " degrees; a bare number is in rad: write \"" + number +
                         " deg\" for degrees");
  };
  check(angle->values ? "values" : "value", angle->Value(), kSteepest);
  check(angle->values ? "values" : "sd", angle->StandardError(), kLargestAngleError);
}

void CheckDensity(const std::optional<MeasuredNumber<base::Dimension::kDensity>>& bulk,
                  double grains, const std::string& place, base::Problems& problems) {
  problems.Require(!bulk || bulk->Value() < grains, place, bulk ? bulk->Value() : 0,
                   "in kg/m^3, must be below the grains' " + base::ShortNumber(grains) +
                       " (powder.material.density): they leave gaps; is one in g/cm^3?");
}

void CheckDensities(const MeasuredNumbers& numbers, double grains, const Place& place,
                    base::Problems& problems) {
  CheckDensity(numbers.Of<Observable::kPouredDensity>(), grains, place("poured_density"), problems);
  CheckDensity(numbers.Of<Observable::kTappedDensity>(), grains, place("tapped_density"), problems);
  CheckDensity(numbers.Of<Observable::kBulkDensity>(), grains, place("bulk_density"), problems);
  const auto& poured = numbers.Of<Observable::kPouredDensity>();
  const auto& tapped = numbers.Of<Observable::kTappedDensity>();
  problems.Require(!poured || !tapped || tapped->Value() >= poured->Value(),
                   place("tapped_density"), tapped ? tapped->Value() : 0,
                   "is below poured_density: taps only compact; are the two exchanged?");
  const auto& ratio = numbers.Of<Observable::kHausnerRatio>();
  problems.Require(!ratio || (ratio->Value() >= 1 && ratio->Value() <= kLargestHausner),
                   place("hausner_ratio"), ratio ? ratio->Value() : 0,
                   "must be in [1, 3]: tapped over poured density; below 1 it is poured over "
                   "tapped, or Carr's index");
}

void CheckMasses(const MeasuredNumbers& numbers, double filled, const Place& place,
                 base::Problems& problems) {
  const auto check = [&](std::string_view key, const auto& mass) {
    problems.Require(!mass || mass->Value() <= kLooseFill * filled, place(key),
                     mass ? mass->Value() : 0,
                     "in kg, is more than the " + base::ShortNumber(filled) +
                         " filled in (powder.mass); write \"21 mg\" for milligrams");
  };
  check("mass_on_plate", numbers.Of<Observable::kMassOnPlate>());
  check("mass_fallen", numbers.Of<Observable::kMassFallen>());
  check("mass_left", numbers.Of<Observable::kMassLeft>());
}

// How high the powder stands in the tube, and how fast that is lifted.
void CheckTube(const rigs::Powder& powder, const rigs::Device& device, const Place& place,
               base::Problems& problems) {
  const double across = device.tube_inner_diameter;
  const double area = std::numbers::pi / 4 * across * across;
  const double height = powder.mass / (kSolidFraction * powder.material.density * area);
  const std::string mass = base::ShortNumber(powder.mass);
  problems.Require(!(height > kMostDiameters * across && powder.material.density > 0),
                   "powder.mass", powder.mass,
                   "in kg, which stands " + base::ShortNumber(height) + " m high in a tube of " +
                       base::ShortNumber(1e3 * across) + " mm; write \"" + mass + " g\" for grams");
  const std::string speed = base::ShortNumber(device.lift_velocity);
  problems.Require(!(device.lift_velocity > kFastestLift), place("device.lift_velocity"),
                   device.lift_velocity,
                   "in m/s, must be at most 5; write \"" + speed + " mm/s\" for millimetres");
}

// What may be filled in at most [kg]: a searched mass is tried up to its largest.
double MostMass(const CampaignSpec& spec, const ExperimentSpec& experiment) {
  if (spec.parameters && spec.parameters->mass) {
    const auto& mass = *spec.parameters->mass;
    return mass.fixed.value_or(mass.max);
  }
  return experiment.mass.value_or(0);
}

}  // namespace

void CheckPlausible(const CampaignSpec& spec, const std::vector<ExperimentSpec>& experiments,
                    base::Problems& problems) {
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const ExperimentSpec& e = experiments[i];
    const Place place(spec.experiments ? "experiments[" + std::to_string(i) + "]" : "");
    CheckAngle(e.numbers.Of<Observable::kAngle>(), place("angle"), problems);
    CheckAngle(e.numbers.Of<Observable::kShearAngle>(), place("shear_angle"), problems);
    CheckDensities(e.numbers, spec.powder.material.density, place, problems);
    if (e.mass) CheckMasses(e.numbers, *e.mass, place, problems);
    if (e.rig && e.rig->kind != rigs::RigKind::kLiftedTube) continue;
    const bool own = spec.experiments && (*spec.experiments)[i].device;
    rigs::Powder powder = spec.powder;
    powder.mass = MostMass(spec, e);
    CheckTube(powder, *e.device, own ? place : Place(""), problems);
  }
}

}  // namespace talus::campaign
