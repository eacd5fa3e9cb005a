// What must hold between a campaign's experiments, and between each and its rig.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "base/text/counted.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "experiments/campaign/spec/plausible.h"
#include "experiments/campaign/spec/validate_numbers.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/rig_list.h"

namespace talus::campaign {
namespace {

// Whether a value in one of these objects has a problem already: one that could not be read has its
// default, of which a rule that ties it to others would speak. "" is no object.
bool HasProblem(const base::Problems& problems, std::initializer_list<std::string> places) {
  return std::ranges::any_of(problems.list(), [&](const base::Problem& problem) {
    return std::ranges::any_of(places, [&](const std::string& place) {
      return !place.empty() && problem.path.starts_with(place + ".");
    });
  });
}

// Images are scaled by the width of plate, drum or box: another one shows another test. So does one
// beside numbers alone.
void CheckWidth(const ExperimentSpec& e, const std::string& place, base::Problems& problems) {
  const bool is_given = e.images.HasImages() || e.images.plate_diameter != 0;
  if (!is_given || HasProblem(problems, {place, "device", "rig"})) return;
  const rigs::Case rig = RigOf(e);
  const double width = rigs::EntryOf(rig).width(rig);
  const bool tube = rig.rig.kind == rigs::RigKind::kLiftedTube;
  problems.Require(
      IsWidthOf(rig, e.images.plate_diameter), place + ".plate_diameter", e.images.plate_diameter,
      tube ? "is not the device's plate_diameter: one of the two is wrong, or the experiment needs "
             "a "
             "device of its own"
           : "is not the width of the rig, " + base::ShortNumber(1e3 * width) +
                 " mm: the data are of another test, or the experiment needs a rig of its own");
}

// A film is compared picture by picture.
void CheckFilm(const ExperimentSpec& e, const std::string& place, base::Problems& problems) {
  if (!e.images.HasImages()) return;
  const int taken = e.images.num_pictures();
  const int simulated = e.rig && e.rig->camera ? e.rig->camera->num_pictures() : 1;
  problems.Require(taken == simulated, place + ".film",
                   "has " + base::Counted(taken, "picture") + " where rig.camera.times has " +
                       base::Counted(simulated, "time") + ": give a picture for each time");
}

// What it is filled with; a drum's photographs show how full it is.
void CheckMass(const CampaignSpec& spec, const ExperimentSpec& e, const std::string& place,
               base::Problems& problems) {
  if (HasProblem(problems, {place})) return;
  const bool is_searched = IsDrum(e.rig) && spec.parameters && spec.parameters->fill;
  problems.Require(!e.mass || !HasFill(e), place + ".mass",
                   "stands beside rig.fill: give one of the two");
  const bool mass_is_searched = spec.parameters && spec.parameters->mass;
  problems.Require(
      e.mass || HasFill(e) || is_searched || mass_is_searched || ShowsDrum(e), "powder.mass",
      "is missing or 0, must be positive: give it, or " +
          (place.empty() ? "" : place + ".mass, or ") + "the photographs or rig.fill of a drum");
}

// What the wall's material gives itself, by the names of the properties.
std::map<std::string, double> PropertiesOf(const rigs::WallMaterial& wall) {
  std::map<std::string, double> properties;
  rigs::WallMaterial::Visit(wall, [&](std::string_view key, const auto& value, base::FieldInfo) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::optional<double>>) {
      if (value) properties.emplace(key, *value);
    }
  });
  return properties;
}

// A material by name is one material, in whatever device it stands.
void CheckNamedWalls(const CampaignSpec& spec, const std::vector<ExperimentSpec>& all,
                     base::Problems& problems) {
  struct Wall {
    std::map<std::string, double> properties;
    std::string owner;
  };
  std::map<std::string, Wall> known;
  const auto check = [&](std::size_t i, const char* key,
                         const std::optional<rigs::WallMaterial>& material) {
    if (!material || !material->name) return;
    const Wall wall{.properties = PropertiesOf(*material),
                    .owner = "the " + std::string(key) + " of \"" + all[i].name + "\""};
    const auto [first, is_new] = known.emplace(*material->name, wall);
    if (is_new || first->second.properties == wall.properties) return;
    const bool own = spec.experiments && (*spec.experiments)[i].device;
    problems.Add((own ? "experiments[" + std::to_string(i) + "]." : "") + "device." + key,
                 "\"" + *material->name + "\" has other properties in " + wall.owner + " than in " +
                     first->second.owner +
                     ": give both the same, or two names where they are two materials");
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    check(i, "tube_material", all[i].device->tube_material);
    check(i, "plate_material", all[i].device->plate_material);
  }
}

// A searched property of the plate or tube is one number for all experiments; where two of them
// give it themselves, with different values, they speak of different materials.
void CheckWalls(const CampaignSpec& spec, const std::vector<ExperimentSpec>& all,
                base::Problems& problems) {
  const optimizer::ParameterSpace space = SpaceOf(spec);
  for (const optimizer::Parameter& p : space.parameters) {
    const ParameterPlace place = PlaceOf(p.name);
    if (place.body == rigs::kPowder || place.is_pair) continue;
    std::set<double> given;
    for (const ExperimentSpec& e : all) {
      const auto& wall =
          place.body == rigs::kFloor ? e.device->plate_material : e.device->tube_material;
      if (!wall) continue;
      for (const auto& [key, value] : PropertiesOf(*wall)) {
        if (key == place.property) given.insert(value);
      }
    }
    problems.Require(given.size() < 2, "parameters." + p.name,
                     "is searched as one number for all experiments, whose devices give it "
                     "different values; leave it out of the devices, or do not search it");
  }
}

// Tubes and plates that nobody reads: of an experiment with another rig, and the campaign's where
// no experiment is a lifted tube.
void CheckDevices(const CampaignSpec& spec, const std::vector<ExperimentSpec>& all,
                  base::Problems& problems) {
  for (std::size_t i = 0; spec.experiments && i < all.size(); ++i) {
    const std::optional<rigs::Device>& own = (*spec.experiments)[i].device;
    const std::string place = "experiments[" + std::to_string(i) + "].device";
    if (own) rigs::RequireNoTube(KindOf(all[i]), *own, place, problems);
  }
  const bool has_tube = std::ranges::any_of(
      all, [](const ExperimentSpec& e) { return KindOf(e) == rigs::RigKind::kLiftedTube; });
  if (!has_tube && !all.empty())
    rigs::RequireNoTube(KindOf(all.front()), spec.device, "device", problems);
}

// An answer needs another experiment than the one that is held out.
void CheckHoldOut(const CampaignSpec& spec, base::Problems& problems) {
  if (!spec.hold_out) return;
  std::vector<std::string> names;
  if (spec.experiments) {
    for (const ExperimentSpec& e : *spec.experiments) names.push_back(e.name);
  }
  if (names.size() < 2) {
    problems.Add("hold_out", "needs two experiments or more: one is held out, the others answer");
    return;
  }
  if (std::find(names.begin(), names.end(), *spec.hold_out) != names.end()) return;
  problems.Add("hold_out", "\"" + *spec.hold_out + "\" is no experiment; there are \"" +
                               base::Joined(names, "\", \"") + "\"");
}

}  // namespace

void ValidateExperiments(const CampaignSpec& spec, base::Problems& problems) {
  problems.Require(spec.experiment || spec.experiments, "experiment",
                   "is missing; without data `talus design` says which tests to make");
  problems.Require(!spec.experiment || !spec.experiments, "experiments",
                   "stands beside experiment: give one of the two");
  CheckHoldOut(spec, problems);
  if (spec.experiment.has_value() == spec.experiments.has_value()) return;
  const std::vector<ExperimentSpec> all = ExperimentsOf(spec);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string place = spec.experiments ? "experiments[" + std::to_string(i) + "]" : "";
    CheckMass(spec, all[i], place, problems);
    ValidateDrumImages(all[i], place.empty() ? "experiment" : place, problems);
    ValidateNeeds(all[i], ScalarsOf(all[i]), place, problems);
  }
  const bool has_drum =
      std::any_of(all.begin(), all.end(), [](const ExperimentSpec& e) { return IsDrum(e.rig); });
  problems.Require(!spec.parameters || !spec.parameters->fill || has_drum, "parameters.fill",
                   "has no effect: it is a drum's; leave it out");
  CheckDevices(spec, all, problems);
  CheckNamedWalls(spec, all, problems);
  CheckPlausible(spec, all, problems);
  if (!spec.experiments) {
    CheckFilm(all.front(), "experiment", problems);
    return CheckWidth(all.front(), "experiment", problems);
  }
  problems.Require(!spec.experiments->empty(), "experiments", "is empty: give one or more");
  std::set<std::string> names;
  for (std::size_t i = 0; i < spec.experiments->size(); ++i) {
    const std::string place = "experiments[" + std::to_string(i) + "]";
    problems.Require(
        names.insert(all[i].name).second, place + ".name",
        "\"" + all[i].name + "\" stands there twice: results could not tell them apart");
    CheckFilm(all[i], place, problems);
    CheckWidth(all[i], place, problems);
    if (spec.engine.kind != EngineKind::kTalus) continue;  // a command may measure what it likes
    ValidateMeasured(all[i], ScalarsOf(all[i]), place, problems);
  }
  if (spec.parameters) CheckWalls(spec, all, problems);
}

}  // namespace talus::campaign
