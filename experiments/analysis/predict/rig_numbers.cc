#include "experiments/analysis/predict/rig_numbers.h"

#include <algorithm>

#include "base/error.h"
#include "base/text/joined.h"
#include "experiments/rigs/rig_list.h"

namespace talus::analysis {

void KeepRigNumbers(const rigs::Case& rig_case, trials::TrialOutput& output) {
  std::vector<std::string> measured;
  for (const rigs::RigObservable& one : rigs::EntryOf(rig_case).observables) {
    measured.push_back(rigs::MetricName(one.observable));
  }
  std::erase_if(output.scalars, [&](const journal::MetricRecord& scalar) {
    return std::ranges::find(measured, scalar.name) == measured.end();
  });
  if (!output.scalars.empty() || !output.profile.pixels.empty()) return;
  throw base::Error("left none of \"" + base::Joined(measured, "\", \"") + "\", which the rig \"" +
                    std::string(base::NameOf(rig_case.rig.kind)) +
                    "\" measures; the engine's templates simulate another test");
}

}  // namespace talus::analysis
