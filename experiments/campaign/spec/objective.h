// What a campaign minimises: a metric of a trial's profile, or for an angle of repose its distance
// from the angle of the experiment.
#pragma once

#include <array>
#include <utility>

#include "base/field.h"

namespace talus::experiments {

enum class Objective { kSad, kRmse, kAor1, kAor2, kAor3 };

constexpr bool IsAngle(Objective objective) {
  return objective != Objective::kSad && objective != Objective::kRmse;
}

}  // namespace talus::experiments

template <>
struct talus::base::Names<talus::experiments::Objective> {
  using O = talus::experiments::Objective;
  static constexpr std::array kList{std::pair{"sad", O::kSad}, std::pair{"rmse", O::kRmse},
                                    std::pair{"aor1", O::kAor1}, std::pair{"aor2", O::kAor2},
                                    std::pair{"aor3", O::kAor3}};
};
