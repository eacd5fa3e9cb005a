#include "engine/scene/pair_spec.h"

namespace talus::engine {

void PairSpec::Validate(base::Problems& problems) const {
  problems.Require(between.size() == 2, "between",
                   "must name two materials; one twice is that with itself");
  problems.Require(stated.Any(), "",
                   "states nothing; give sliding_friction or another property, or remove it");
  stated.Validate(problems);
}

}  // namespace talus::engine
