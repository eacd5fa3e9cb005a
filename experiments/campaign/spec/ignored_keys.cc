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
    const auto stands_there = [&](const char* key) { return !range.value(key, json()).is_null(); };
    const char* const keys[] = {"min", "max", "guess"};
    const auto* const beside = std::ranges::find_if(keys, stands_there);
    problems.Require(beside == std::end(keys), "parameters." + name + ".fixed",
                     "stands beside " + std::string(beside == std::end(keys) ? "" : *beside) +
                         ", which is of a parameter that is searched: keep one of the two");
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

// Whether the experiment is filled with powder.mass.
bool TakesMass(const CampaignSpec& spec, const std::vector<ExperimentSpec>& all, std::size_t i) {
  const bool has_own = spec.experiments && (*spec.experiments)[i].mass;
  return !has_own && !HasFill(all[i]);
}

// A drum is as full as its fill says; the mass is of other tests, where there are any.
void RefuseMassBesideFill(const CampaignSpec& spec, const std::vector<ExperimentSpec>& all,
                          base::Problems& problems) {
  if (spec.powder.mass == 0) return;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (TakesMass(spec, all, i)) return;
  }
  const auto full = std::ranges::find_if(all, HasFill);
  if (full == all.end()) return;
  const auto index = static_cast<std::size_t>(full - all.begin());
  const bool has_own = spec.experiments && (*spec.experiments)[index].rig;
  problems.Add((has_own ? "experiments[" + std::to_string(index) + "]." : "") + "rig.fill",
               "stands beside powder.mass, which no test is filled with: give one of the two");
}

// A searched mass is that of every test.
void RefuseOwnMass(const CampaignSpec& spec, base::Problems& problems) {
  if (!spec.parameters || !spec.parameters->mass || !spec.experiments) return;
  for (std::size_t i = 0; i < spec.experiments->size(); ++i) {
    problems.Require(!(*spec.experiments)[i].mass, "experiments[" + std::to_string(i) + "].mass",
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
  RefuseScaleFactor(root, spec.coarse_graining, problems);
  if (spec.experiment.has_value() == spec.experiments.has_value()) return;  // that is said already
  const std::vector<ExperimentSpec> all = ExperimentsOf(spec);
  RefuseMassBesideFill(spec, all, problems);
  RefuseOwnMass(spec, problems);
  RefuseObjective(root, spec, all, problems);
}

}  // namespace talus::campaign
