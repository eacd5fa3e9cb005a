#include "experiments/campaign/spec/validate_numbers.h"

#include <algorithm>
#include <cstddef>

#include "base/nearest.h"
#include "base/text/joined.h"
#include "experiments/rigs/rig_list.h"

namespace talus::campaign {
namespace {

using O = rigs::Observable;

std::string PathOf(const std::string& place, std::string_view key) {
  return (place.empty() ? "" : place + ".") + std::string(key);
}

bool Has(const std::vector<ScalarSpec>& numbers, O observable) {
  const auto& key = rigs::InfoOf(observable).key;
  return std::ranges::any_of(numbers, [&](const ScalarSpec& n) { return n.key == key; });
}

// A line takes two stresses of a shear cell, and each shear stress its own.
void ValidateStresses(std::size_t given, const std::vector<ScalarSpec>& numbers,
                      const std::string& place, base::Problems& problems) {
  const auto require = [&](std::size_t least, O observable) {
    problems.Require(!Has(numbers, observable) || given >= least,
                     PathOf(place, rigs::InfoOf(observable).key),
                     "needs " + std::to_string(least) + " normal stresses, and rig.stresses has " +
                         std::to_string(given) + ": give all that it was measured at");
  };
  require(2, O::kFrictionAngle);
  require(2, O::kCohesion);
  require(2, O::kShearStress2);
  require(3, O::kShearStress3);
}

}  // namespace

void ValidateMeasured(const ExperimentSpec& e, const std::vector<ScalarSpec>& numbers,
                      const std::string& place, base::Problems& problems) {
  const rigs::Case rig = RigOf(e);
  const auto known = rigs::EntryOf(rig).observables;
  std::vector<std::string> keys;
  for (const rigs::RigObservable& o : known) keys.emplace_back(rigs::InfoOf(o.observable).key);
  for (const ScalarSpec& scalar : numbers) {
    const auto name = [](const rigs::RigObservable& o) { return rigs::MetricName(o.observable); };
    if (std::ranges::find(known, scalar.metric, name) != known.end()) continue;
    problems.Add(PathOf(place, scalar.key),
                 "is not measured by the rig " + std::string(base::NameOf(rig.rig.kind)) +
                     ", which measures " + base::Joined(known, ", ", name) +
                     base::DidYouMean(scalar.key, keys) +
                     "; remove it, or name the rig of this test");
  }
}

void ValidateNeeds(const ExperimentSpec& e, const std::vector<ScalarSpec>& numbers,
                   const std::string& place, base::Problems& problems) {
  const bool filmed = e.rig && e.rig->camera;
  problems.Require(!Has(numbers, O::kCohesiveIndex) || filmed,
                   PathOf(place, rigs::InfoOf(O::kCohesiveIndex).key),
                   "needs a camera: give the rig \"camera\": {\"frames\": 20, \"interval\": "
                   "\"10 ms\"}, as the test's own");
  if (!e.rig || e.rig->kind != rigs::RigKind::kShearCell) return;
  ValidateStresses(e.rig->shear_cell.stresses.size(), numbers, place, problems);
}

}  // namespace talus::campaign
