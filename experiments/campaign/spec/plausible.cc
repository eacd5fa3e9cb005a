#include "experiments/campaign/spec/plausible.h"

#include <string>
#include <string_view>
#include <utility>

#include "base/text/number_text.h"
#include "engine/bodies/particle.h"
#include "experiments/campaign/spec/agreeing_numbers.h"
#include "experiments/campaign/spec/plausible_stresses.h"
#include "experiments/campaign/spec/possible_numbers.h"
#include "experiments/rigs/case/plausible_quantity.h"

namespace talus::campaign {
namespace {

using rigs::BenchQuantity;
using rigs::Observable;
using rigs::RequirePlausible;

constexpr double kFewestGrains = 20;  // that could make a heap
constexpr double kLooseFill = 1.02;   // of the mass filled: a balance is that good
constexpr double kLargestHausner = 3;
constexpr double kFastestFlow = 0.02;  // in which all that was filled runs out [s]

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

void CheckDensity(const std::optional<MeasuredNumber<base::Dimension::kDensity>>& bulk,
                  double grains, const std::string& place, base::Problems& problems) {
  problems.Require(!bulk || bulk->Value() < grains, place, bulk ? bulk->Value() : 0,
                   "in kg/m^3, must be below the grains' " + base::ShortNumber(grains) +
                       " (powder.material.density): they leave gaps; is one in g/cm^3?");
  // As g/cm^3 it would be one, and hardly any powder lies at a few kilograms in a cubic metre.
  problems.Require(!bulk || 1000 * bulk->Value() >= grains, place, bulk ? bulk->Value() : 0,
                   "in kg/m^3, is next to nothing; write \"" +
                       base::ShortNumber(bulk ? bulk->Value() : 0) + " g/cm^3\" for g/cm^3");
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

// `filled_by`: the key of the mass.
void CheckMasses(const MeasuredNumbers& numbers, double filled, const std::string& filled_by,
                 const Place& place, base::Problems& problems) {
  const auto check = [&](std::string_view key, const auto& mass) {
    problems.Require(
        !mass || mass->Value() <= kLooseFill * filled, place(key), mass ? mass->Value() : 0,
        "in kg, is more than the " + base::ShortNumber(filled) + " filled in (" + filled_by +
            "); a number without a unit is in kg: write \"21 mg\" for milligrams");
  };
  check("mass_on_plate", numbers.Of<Observable::kMassOnPlate>());
  check("mass_fallen", numbers.Of<Observable::kMassFallen>());
  check("mass_left", numbers.Of<Observable::kMassLeft>());
  const auto& rate = numbers.Of<Observable::kDischargeRate>();
  problems.Require(!rate || rate->Value() * kFastestFlow <= filled, place("discharge_rate"),
                   rate ? rate->Value() : 0,
                   "in kg/s, would empty the " + base::ShortNumber(filled) + " kg filled in (" +
                       filled_by + ") within " +
                       base::ShortNumber(rate ? filled / rate->Value() : 0, 2) +
                       " s; is it in grams a second (\"g/s\")?");
}

// Both ends of a range, or the value that it is held at.
template <class Range>
void RequirePlausibleRange(BenchQuantity quantity, const std::optional<Range>& range,
                           const std::string& name, base::Problems& problems) {
  if (!range) return;
  const std::string path = "parameters." + name + ".";
  if (range->fixed) return RequirePlausible(quantity, *range->fixed, path + "fixed", problems);
  RequirePlausible(quantity, range->min, path + "min", problems);
  RequirePlausible(quantity, range->max, path + "max", problems);
}

void CheckPowder(const CampaignSpec& spec, base::Problems& problems) {
  rigs::RequirePlausibleGrains(spec.powder, problems);
  if (!spec.parameters) return;
  RequirePlausibleRange(BenchQuantity::kGrainDensity, spec.parameters->density, "density",
                        problems);
  RequirePlausibleRange(BenchQuantity::kYoungsModulus, spec.parameters->youngs_modulus,
                        "youngs_modulus", problems);
  if (!spec.parameters->surface_energy) return;
  const auto& searched = *spec.parameters->surface_energy;
  RequirePlausible(BenchQuantity::kSurfaceEnergy, searched.fixed.value_or(searched.max),
                   std::string("parameters.surface_energy.") + (searched.fixed ? "fixed" : "max"),
                   problems);
}

// One of the numbers that give it is wrong, and nothing tells which.
void CheckNumberOfGrains(const rigs::Powder& powder, const std::string& path,
                         base::Problems& problems) {
  const double diameter = rigs::TypicalDiameter(powder.sizes).second;
  const double one = engine::SphereMass(powder.material, diameter / 2);
  const double number = powder.mass / one;
  if (!(number < kFewestGrains) || !(powder.mass > 0)) return;
  problems.Add(path, "of " + base::ShortNumber(powder.mass) + " kg is " +
                         base::ShortNumber(number, 2) + " grains of " +
                         base::ShortNumber(1e3 * diameter) + " mm and " +
                         base::ShortNumber(powder.material.density) +
                         " kg/m^3: one of the three has another unit");
}

Surroundings Around(const CampaignSpec& spec, const rigs::Powder& powder, std::string prefix,
                    std::string filled_by) {
  Surroundings around{.prefix = std::move(prefix),
                      .grain_density = powder.material.density,
                      .filled = powder.mass,
                      .filled_by = std::move(filled_by)};
  if (spec.parameters && spec.parameters->density) around.grain_density.reset();
  return around;
}

}  // namespace

double MostDensity(const CampaignSpec& spec) {
  if (!spec.parameters || !spec.parameters->density) return spec.powder.material.density;
  const auto& density = *spec.parameters->density;
  return density.fixed.value_or(density.max);
}

double MostMass(const CampaignSpec& spec, const ExperimentSpec& experiment) {
  if (spec.parameters && spec.parameters->mass) {
    const auto& mass = *spec.parameters->mass;
    return mass.fixed.value_or(mass.max);
  }
  return experiment.mass.value_or(0);
}

void CheckPlausible(const CampaignSpec& spec, const std::vector<ExperimentSpec>& experiments,
                    base::Problems& problems) {
  const std::size_t before = problems.size();
  CheckPowder(spec, problems);
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const ExperimentSpec& e = experiments[i];
    const Place place(spec.experiments ? "experiments[" + std::to_string(i) + "]" : "");
    RequirePossible(e.numbers, place(""), problems);
    CheckStresses(e, place(""), problems);
    CheckDensities(e.numbers, MostDensity(spec), place, problems);
    rigs::Powder powder = spec.powder;
    powder.mass = MostMass(spec, e);
    const bool own_mass = spec.experiments && (*spec.experiments)[i].mass;
    const std::string mass = own_mass ? place("mass") : "powder.mass";
    // One that could not be read is 0.
    if (powder.mass > 0) CheckMasses(e.numbers, powder.mass, mass, place, problems);
    const bool is_tube = !e.rig || e.rig->kind == rigs::RigKind::kLiftedTube;
    const bool own_device = spec.experiments && (*spec.experiments)[i].device;
    if (is_tube) {
      const Place at = own_device ? place : Place("");
      rigs::RequirePlausibleTube(*e.device, at("device"), problems);
    } else {
      rigs::RequirePlausibleRig(*e.rig, place("rig"), problems);
    }
    if (problems.size() > before) continue;  // what is wrong by itself is said of itself
    RequireAgreeing(e, Around(spec, powder, place(""), mass), problems);
    CheckNumberOfGrains(powder, mass, problems);
  }
}

}  // namespace talus::campaign
