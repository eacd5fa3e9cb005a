#include "experiments/campaign/spec/ignored_keys.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/campaign/spec/drum_images.h"

namespace talus::campaign {
namespace {

using nlohmann::json;

// A fixed parameter is not searched, wherever its range lies.
void RefuseRangesOfFixed(const json& root, base::Problems& problems) {
  const auto parameters = root.find("parameters");
  if (parameters == root.end() || !parameters->is_object()) return;
  for (const auto& [name, range] : parameters->items()) {
    if (!range.is_object() || range.value("fixed", json()).is_null()) continue;
    const auto stands_there = [&beside_fixed = range](const char* key) {
      return !beside_fixed.value(key, json()).is_null();
    };
    const char* const keys[] = {"min", "max", "guess"};
    const auto* const beside = std::ranges::find_if(keys, stands_there);
    problems.Require(beside == std::end(keys), "parameters." + name + ".fixed",
                     "stands beside " + std::string(beside == std::end(keys) ? "" : *beside) +
                         ", which is of a parameter that is searched: keep one of the two");
  }
}

// What is filled in when a campaign begins, or a test or a parameter is added to it.
void RefuseOwnKeys(const json& root, base::Problems& problems) {
  constexpr const char* kOurs = "is filled in by talus: leave it out";
  problems.Require(!root.contains("num_added"), "num_added", kOurs);
  const auto engine = root.find("engine");
  if (engine != root.end() && engine->is_object()) {
    problems.Require(!engine->contains("templates_hash"), "engine.templates_hash", kOurs);
  }
  const auto parameters = root.find("parameters");
  if (parameters == root.end() || !parameters->is_object()) return;
  for (const auto& [name, range] : parameters->items()) {
    problems.Require(!range.is_object() || !range.contains("added_at"),
                     "parameters." + name + ".added_at", kOurs);
  }
}

// One that is no default is refused with the rest (GrainSizes::Validate).
void RefuseScaleFactor(const json& root, const GrainSizes& sizes, base::Problems& problems) {
  const auto given = root.find("coarse_graining");
  if (given == root.end() || !given->contains("scale_factor") || !sizes.scale_factors) return;
  problems.Require(sizes.scale_factor != 1 || sizes.Levels().back() == 1,
                   "coarse_graining.scale_factor",
                   "stands beside scale_factors: give one of the two");
}

// What is put into the tests, of which each takes one: `all` as ExperimentsOf(spec).
struct TestFillings {
  const CampaignSpec& spec;
  const std::vector<ExperimentSpec>& all;

  bool FillIsSearched() const { return spec.parameters && spec.parameters->fill; }
  bool MassIsSearched() const { return spec.parameters && spec.parameters->mass; }
  // A drum is as full as its fill says, its own or that of all drums.
  bool ByFill(const ExperimentSpec& e) const {
    return HasFill(e) || (IsDrum(e.rig) && FillIsSearched());
  }
  bool AllByFill() const {
    return std::ranges::all_of(all, [&](const ExperimentSpec& e) { return ByFill(e); });
  }
  bool HasOwnMass(std::size_t i) const {
    return spec.experiments && (*spec.experiments)[i].mass.has_value();
  }
  std::string Place(std::size_t i) const {
    return spec.experiments ? "experiments[" + std::to_string(i) + "]." : "";
  }
  std::string PlaceOfRig(std::size_t i) const {
    return (spec.experiments && (*spec.experiments)[i].rig ? Place(i) : "") + "rig.";
  }
};

// The mass is of other tests than drums with a fill, where there are any.
void RefuseMassBesideFill(const TestFillings& filled, base::Problems& problems) {
  if (filled.MassIsSearched() && filled.AllByFill()) {
    problems.Add("parameters.mass",
                 "has no effect: every test is a drum that is as full as its fill says; leave it "
                 "out, or the fill");
  }
  if (filled.spec.powder.mass == 0) return;
  for (std::size_t i = 0; i < filled.all.size(); ++i) {
    if (!filled.HasOwnMass(i) && !filled.ByFill(filled.all[i])) return;
  }
  const auto full =
      std::ranges::find_if(filled.all, [&](const ExperimentSpec& e) { return filled.ByFill(e); });
  if (full == filled.all.end()) return;
  const auto index = static_cast<std::size_t>(full - filled.all.begin());
  problems.Add(HasFill(*full) ? filled.PlaceOfRig(index) + "fill" : "parameters.fill",
               "stands beside powder.mass, which no test is filled with: give one of the two");
}

// A searched fill is that of every drum.
void RefuseOwnFill(const TestFillings& filled, base::Problems& problems) {
  if (!filled.FillIsSearched()) return;
  constexpr const char* kRemedy =
      "stands beside parameters.fill, which every drum is filled by: keep one of the two";
  for (std::size_t i = 0; i < filled.all.size(); ++i) {
    if (!IsDrum(filled.all[i].rig)) continue;
    problems.Require(!HasFill(filled.all[i]), filled.PlaceOfRig(i) + "fill", kRemedy);
    problems.Require(!filled.HasOwnMass(i), filled.Place(i) + "mass", kRemedy);
  }
}

// A searched mass is that of every test.
void RefuseOwnMass(const TestFillings& filled, base::Problems& problems) {
  if (!filled.MassIsSearched()) return;
  for (std::size_t i = 0; i < filled.all.size(); ++i) {
    problems.Require(!filled.HasOwnMass(i), filled.Place(i) + "mass",
                     "stands beside parameters.mass, which every test is filled with: keep one of "
                     "the two");
  }
}

// What images are compared by; numbers alone are met by their errors.
void RefuseObjective(const json& root, const CampaignSpec& spec,
                     const std::vector<ExperimentSpec>& all, base::Problems& problems) {
  const bool has_image =
      std::ranges::any_of(all, [](const ExperimentSpec& e) { return e.images.HasImages(); });
  problems.Require(has_image || all.empty() || !root.contains("objective"), "objective",
                   "\"" + std::string(base::NameOf(spec.objective)) +
                       "\" is of an image, and no experiment has one: numbers are met by their "
                       "errors, leave it out");
}

}  // namespace

void RefuseIgnoredKeys(const base::JsonFile& file, const CampaignSpec& spec,
                       base::Problems& problems) {
  const json& root = file.root;
  RefuseRangesOfFixed(root, problems);
  RefuseOwnKeys(root, problems);
  RefuseScaleFactor(root, spec.coarse_graining, problems);
  if (spec.experiment.has_value() == spec.experiments.has_value()) return;  // that is said already
  const std::vector<ExperimentSpec> all = ExperimentsOf(spec);
  const TestFillings filled{spec, all};
  RefuseMassBesideFill(filled, problems);
  RefuseOwnFill(filled, problems);
  RefuseOwnMass(filled, problems);
  RefuseObjective(root, spec, all, problems);
}

}  // namespace talus::campaign
