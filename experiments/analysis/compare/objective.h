// The objectives a campaign can be judged by: each a metric of the profile, or for an angle of
// repose its distance from the angle of the experiment.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

namespace talus::experiments {

struct ObjectiveInfo {
  std::string_view key;     // as in a spec
  std::string_view metric;  // that it is made of: imaging's name
  std::string_view title;   // as in a heading
  std::string_view unit;    // of the metric, for people
  bool is_angle = false;    // objective = |quantity - that of the experiment|

  double Value(double quantity, double reference) const {
    return is_angle ? std::abs(quantity - reference) : quantity;
  }
};

inline constexpr std::array kObjectives{
    ObjectiveInfo{"sad", "sad_mm2", "SAD", "mm²"},
    ObjectiveInfo{"rmse", "rmse_gray", "RMSE", "grey levels"},
    ObjectiveInfo{"aor1", "repose_angle_1_mean_deg", "AOR 1", "°", true},
    ObjectiveInfo{"aor2", "repose_angle_2_mean_deg", "AOR 2", "°", true},
    ObjectiveInfo{"aor3", "repose_angle_3_mean_deg", "AOR 3", "°", true},
};

}  // namespace talus::experiments
