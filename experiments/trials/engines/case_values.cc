#include "experiments/trials/engines/case_values.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <type_traits>

#include "base/prime.h"
#include "base/random.h"
#include "base/text/number_text.h"
#include "engine/scene/size_distribution.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/case/time_step.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/rig_list.h"

namespace talus::trials {
namespace {

// LAMMPS and LIGGGHTS refuse seeds from 900 million on, and 0.
std::uint64_t PlainSeed(std::uint64_t seed) { return 1 + seed % 899999999; }

// LIGGGHTS wants primes above 10000. Seeds that follow each other must not meet in one prime, so
// that they are scattered first.
std::uint64_t PrimeSeed(std::uint64_t seed) {
  return base::PrimeFrom(10007 + base::Mix64(seed) % 800000000);
}

using Scalars = std::map<std::string, std::string, std::less<>>;

void AddMaterial(const std::string& prefix, const engine::Material& material, Scalars& scalars) {
  engine::Material::Visit(material, [&](std::string_view key, double value, base::FieldInfo) {
    scalars[prefix + std::string(key)] = base::ExactNumber(value);
  });
}

void AddDevice(const rigs::Case& c, Scalars& scalars) {
  const rigs::LiftedTubeOptions& device = c.rig.lifted_tube;
  const std::pair<const char*, double> kLengths[] = {
      {"tube_inner_diameter", device.tube_inner_diameter},
      {"tube_inner_radius", device.tube_inner_diameter / 2},
      {"plate_diameter", device.plate_diameter},
      {"plate_radius", device.plate_diameter / 2},
      {"plate_height", device.plate_height},
      {"lift_velocity", device.lift_velocity}};
  for (const auto& [name, value] : kLengths) scalars[name] = base::ExactNumber(value);
  const engine::Material& powder = c.powder.material;
  AddMaterial("tube_", c.materials.walls.value_or(rigs::WallMaterial{}).Over(powder), scalars);
  AddMaterial("plate_", c.materials.floor.value_or(rigs::WallMaterial{}).Over(powder), scalars);
}

// "plate_pair_", which the names of a pair's properties follow.
std::string PairPrefix(int body) { return std::string(rigs::kBodyNames[body]) + "_pair_"; }

// What acts between grains and each body, whether stated or mixed.
void AddPairs(const rigs::Case& c, Scalars& scalars) {
  const std::vector<engine::Material> materials = rigs::MaterialsOf(c);
  const std::vector<engine::MaterialPair> pairs = rigs::PairsOf(c);
  for (const int body : {rigs::kPowder, rigs::kWalls, rigs::kFloor}) {
    const engine::PairProperties all = engine::Joined(materials[rigs::kPowder], materials[body],
                                                      engine::StatedOf(pairs, rigs::kPowder, body));
    engine::PairProperties::Visit(
        all, [&](std::string_view key, const std::optional<double>& value, base::FieldInfo) {
          scalars[PairPrefix(body) + std::string(key)] = base::ExactNumber(value.value());
        });
  }
}

// {{ rig_length }}, {{ rig_taps_count }}, …: the keys of the rig's kind.
struct RigValues {
  Scalars& scalars;
  std::string prefix;

  template <class Kind>
  requires std::is_enum_v<Kind>
  void operator()(std::string_view key, Kind kind, base::FieldInfo = {}) {
    scalars[prefix + std::string(key)] = base::NameOf(kind);
  }
  void operator()(std::string_view key, double value, base::FieldInfo = {}) {
    scalars[prefix + std::string(key)] = base::ExactNumber(value);
  }
  void operator()(std::string_view key, const std::vector<double>& values, base::FieldInfo = {}) {
    scalars[prefix + "num_" + std::string(key)] = std::to_string(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      (*this)(std::string(key) + "_" + std::to_string(i + 1), values[i]);
    }
  }
  template <base::Visitable Group>
  void operator()(std::string_view key, const Group& group, base::FieldInfo = {}) {
    Group::Visit(group, RigValues{scalars, prefix + std::string(key) + "_"});
  }
  template <class Value>
  void operator()(std::string_view key, const std::optional<Value>& value, base::FieldInfo = {}) {
    if (value) (*this)(key, *value);
  }
};

// The powder as it is simulated: scaled, and counted.
void AddSizes(const rigs::Case& c, Scalars& scalars) {
  const double factor = c.coarse_graining.scale_factor;
  const engine::SizeCurve curve(c.powder.sizes);
  const rigs::CaseSize size = rigs::EstimateCase(c);
  scalars["scale_factor"] = base::ExactNumber(factor);
  scalars["smallest_diameter"] = base::ExactNumber(factor * curve.smallest());
  scalars["largest_diameter"] = base::ExactNumber(factor * curve.largest());
  scalars["mean_diameter"] = base::ExactNumber(size.mean_diameter);
  scalars["num_grains"] = std::to_string(size.num_grains);
  scalars["mass"] = base::ExactNumber(c.powder.mass);
  scalars["filled_height"] = base::ExactNumber(size.filled_height);
  scalars["tube_length"] =
      base::ExactNumber(c.rig.lifted_tube.tube_length.value_or(size.filled_height));
  // The tube is lifted by little more than the powder's height.
  scalars["box_height"] =
      base::ExactNumber(4 * c.rig.lifted_tube.tube_length.value_or(size.filled_height) +
                        2 * c.rig.lifted_tube.plate_diameter);
  scalars["time_step"] = base::ExactNumber(size.time_step);
}

bool IsOneOf(std::string_view name, std::span<const std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

// "tube" of "tube_sliding_friction", whose powder's namesake is another; "" of the powder's own.
std::string_view BodyOf(std::string_view name) {
  for (const std::string_view body : {"plate", "tube"}) {
    if (name.starts_with(body) && name.substr(body.size()).starts_with('_')) return body;
  }
  return "";
}

}  // namespace

TemplateValues CaseValues(const rigs::Case& c) {
  TemplateValues values;
  Scalars& scalars = values.scalars;
  AddMaterial("", c.powder.material, scalars);
  scalars["surface_energy_used"] = base::ExactNumber(rigs::UsedMaterial(c).surface_energy);
  scalars["full_mobilisation_damping"] = base::ExactNumber(c.models.full_mobilisation_damping);
  scalars["adhesion_cutoff"] = base::ExactNumber(c.models.adhesion_cutoff);
  scalars["rayleigh_fraction"] = base::ExactNumber(rigs::StepFraction(c));
  scalars["gravity"] = base::ExactNumber(c.gravity);
  scalars["settling_time"] = base::ExactNumber(c.rules.settling.max_time);
  scalars["rest_time"] = base::ExactNumber(c.rules.heap.max_time);
  // For decks that cannot calculate.
  const double lifted = c.rules.settling.max_time +
                        1.2 * rigs::EstimateCase(c).filled_height / c.rig.lifted_tube.lift_velocity;
  scalars["lifted_time"] = base::ExactNumber(lifted);
  scalars["end_time"] = base::ExactNumber(lifted + c.rules.heap.max_time);
  scalars["seed"] = std::to_string(PlainSeed(c.seed));
  scalars["prime_seed"] = std::to_string(PrimeSeed(c.seed));
  scalars["threads"] = std::to_string(c.threads);
  AddSizes(c, scalars);
  AddDevice(c, scalars);
  AddPairs(c, scalars);
  rigs::RigOptions::Visit(c.rig, RigValues{scalars, "rig_"});
  if (const auto fill = rigs::FillOf(c)) scalars["rig_fill"] = base::ExactNumber(*fill);
  values.tables["grains"] = {.columns = {"number", "x", "y", "z", "diameter", "radius"},
                             .rows = {}};
  return values;
}

std::vector<std::string> StatedPlaceholders(const rigs::Case& c) {
  std::vector<std::string> names;
  for (const engine::PairSpec& pair : c.pairs) {
    engine::PairProperties::Visit(
        pair.stated,
        [&](std::string_view key, const std::optional<double>& value, base::FieldInfo) {
          if (value) names.push_back(PairPrefix(*rigs::PartnerOf(pair)) + std::string(key));
        });
  }
  return names;
}

std::vector<std::string> PlaceholdersOf(const std::string& parameter, const rigs::Case& low,
                                        const rigs::Case& high) {
  static constexpr std::string_view kSizes[] = {
      "num_grains",       "mass",          "smallest_diameter", "mean_diameter",
      "largest_diameter", "filled_height", "tube_length",       "rig_fill"};
  static constexpr std::string_view kOfTheRun[] = {"time_step", "lifted_time", "end_time",
                                                   "box_height"};
  const TemplateValues at_low = CaseValues(low);
  const TemplateValues at_high = CaseValues(high);
  const bool is_of_bulk = IsOneOf(parameter, kSizes) || !at_low.scalars.contains(parameter);
  std::vector<std::string> names;
  for (const auto& [name, value] : at_low.scalars) {
    const auto other = at_high.scalars.find(name);
    if (other != at_high.scalars.end() && other->second == value) continue;
    if (IsOneOf(name, kOfTheRun) || IsOneOf(name, kSizes) != is_of_bulk) continue;
    if (is_of_bulk || BodyOf(name) == BodyOf(parameter)) names.push_back(name);
  }
  if (is_of_bulk && !names.empty()) names.emplace_back("grains");
  if (names.empty()) names.push_back(parameter);
  std::stable_partition(names.begin(), names.end(),
                        [&](const auto& name) { return name == parameter; });
  return names;
}

void AddGrains(const rigs::Case& c, TemplateValues& values) {
  TemplateTable& table = values.tables.at("grains");
  rigs::Case dense = c;  // another engine gets its grains in place
  dense.filling = {};
  const rigs::FilledScene made = rigs::FillVessel(dense, rigs::EntryOf(dense).vessel(dense));
  // The exact number, which the estimate may miss by one.
  values.scalars["num_grains"] = std::to_string(made.scene.particles.size());
  for (const engine::Particle& p : made.scene.particles) {
    table.rows.push_back({std::to_string(table.rows.size() + 1), base::ExactNumber(p.position.x),
                          base::ExactNumber(p.position.y), base::ExactNumber(p.position.z),
                          base::ExactNumber(2 * p.radius), base::ExactNumber(p.radius)});
  }
}

}  // namespace talus::trials
