#include "experiments/campaign/spec/experiment_spec.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json/json_writer.h"
#include "base/text/name.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/rigs/rig_list.h"

namespace talus::campaign {
namespace {

// Keys of images that there are none of would be believed to act. Not the width, which says how
// wide the test is (validate_experiments.cc).
void RequireNoImageKeys(const imaging::ExperimentOptions& images, base::Problems& problems) {
  const nlohmann::ordered_json given = base::ToJson(images);
  const nlohmann::ordered_json usual = base::ToJson(imaging::ExperimentOptions{});
  for (const auto& [key, value] : given.items()) {
    if (key == "plate_diameter" || (usual.contains(key) && usual[key] == value)) continue;
    problems.Add(key, "has no effect without photos, runs or a map: give these, or leave it out");
  }
}

}  // namespace

void ExperimentSpec::Validate(base::Problems& problems) const {
  base::RequireName(problems, "name", name);
  problems.Require(weight > 0 && weight <= 100, "weight", weight,
                   "must be positive, and at most 100; leave the experiment out instead of 0");
  const bool has_numbers = !ScalarsOf(*this).empty();
  problems.Require(images.HasImages() || has_numbers, "",
                   "has no data: give photos, runs or a map, or numbers with their errors such as "
                   "\"mass_fallen\": {\"value\": \"21 mg\", \"sd\": \"2 mg\"}");
  problems.RequirePositive("mass", mass);
  if (!images.HasImages()) return RequireNoImageKeys(images, problems);
  imaging::ExperimentOptions complete = images;
  SetDrumDiameter(rig, complete);
  complete.Validate(problems);
}

rigs::Case RigOf(const ExperimentSpec& experiment) {
  rigs::Case rig_case;
  rig_case.rig = experiment.rig.value_or(rigs::RigOptions{});
  rig_case.SetDevice(*experiment.device);
  return rig_case;
}

bool IsWidthOf(const rigs::Case& rig_case, double width) {
  const double own = rigs::EntryOf(rig_case).width(rig_case);
  return std::abs(width - own) <= 0.01 * own;
}

}  // namespace talus::campaign
