// What a campaign minimises, and what its trials can be judged by: a metric of a trial's profile,
// or for an angle of repose its distance from the angle of the experiment. A new objective is one
// entry in the enum and one in the table; spec, reference, journal and analysis read the table.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "base/field.h"

namespace talus::journal {

enum class Objective { kSad, kRmse, kAor1, kAor2, kAor3 };

struct ObjectiveInfo {
  Objective objective = Objective::kSad;
  std::string_view key;     // as in a spec
  std::string_view metric;  // that it is made of: imaging's name
  std::string_view title;   // as in a heading
  std::string_view unit;    // of the metric, for people
  bool is_angle = false;    // objective = |quantity - that of the experiment|

  double Value(double quantity, double reference) const {
    return is_angle ? std::abs(quantity - reference) : quantity;
  }

  // The value's key, with its unit: "sad_mm2", "aor2_difference_deg".
  std::string ValueKey() const {
    return is_angle ? std::string(key) + "_difference_deg" : std::string(metric);
  }
};

inline constexpr std::array kObjectives{
    ObjectiveInfo{Objective::kSad, "sad", "sad_mm2", "SAD", "mm²"},
    ObjectiveInfo{Objective::kRmse, "rmse", "rmse_gray", "RMSE", "grey levels"},
    ObjectiveInfo{Objective::kAor1, "aor1", "repose_angle_1_mean_deg", "AOR 1", "°", true},
    ObjectiveInfo{Objective::kAor2, "aor2", "repose_angle_2_mean_deg", "AOR 2", "°", true},
    ObjectiveInfo{Objective::kAor3, "aor3", "repose_angle_3_mean_deg", "AOR 3", "°", true},
};

// The table is in the order of the enum.
static_assert([] {
  for (std::size_t i = 0; i < kObjectives.size(); ++i) {
    if (static_cast<std::size_t>(kObjectives[i].objective) != i) return false;
  }
  return true;
}());

constexpr const ObjectiveInfo& InfoOf(Objective objective) {
  return kObjectives.at(static_cast<std::size_t>(objective));
}

}  // namespace talus::journal

template <>
struct talus::base::Names<talus::journal::Objective> {
  static constexpr auto kList = [] {
    using talus::journal::kObjectives;
    std::array<std::pair<std::string_view, talus::journal::Objective>, kObjectives.size()> list;
    for (std::size_t i = 0; i < list.size(); ++i) {
      list[i] = {kObjectives[i].key, kObjectives[i].objective};
    }
    return list;
  }();
};
