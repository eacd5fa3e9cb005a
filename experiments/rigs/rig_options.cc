#include "experiments/rigs/rig_options.h"

#include <cmath>
#include <numbers>

namespace talus::rigs {
namespace {

constexpr double kLargest = 2;  // [m]

void RequireLength(base::Problems& problems, const char* key, double value) {
  problems.Require(value > 0 && value <= kLargest, key, value,
                   "must be positive and at most 2 m; write \"10 mm\" for 10 mm");
}

}  // namespace

std::vector<RigOptions> RigOptions::Alternatives() {
  std::vector<RigOptions> all;
  for (const auto& [name, kind] : base::Names<RigKind>::kList) {
    RigOptions options;
    options.kind = kind;
    all.push_back(options);
  }
  return all;
}

// The taps check themselves.
void TappedDensityOptions::Validate(base::Problems& problems) const {
  RequireLength(problems, "diameter", diameter);
}

void ColumnCollapseOptions::Validate(base::Problems& problems) const {
  RequireLength(problems, "length", length);
  RequireLength(problems, "width", width);
  problems.Require(!gate_velocity || (*gate_velocity > 0 && std::isfinite(*gate_velocity)),
                   "gate_velocity", gate_velocity.value_or(0), "must be positive");
}

void TiltingBoxOptions::Validate(base::Problems& problems) const {
  RequireLength(problems, "length", length);
  RequireLength(problems, "width", width);
  problems.Require(!lip_height || (*lip_height >= 0 && *lip_height <= kLargest), "lip_height",
                   lip_height.value_or(0), "must not be negative, and at most 2 m");
  problems.Require(rate > 0 && std::isfinite(rate), "rate", rate, "must be positive");
  problems.Require(largest_angle > 0 && largest_angle <= std::numbers::pi / 2, "largest_angle",
                   largest_angle, "must be positive and at most 90 deg");
}

void DrawDownOptions::Validate(base::Problems& problems) const {
  RequireLength(problems, "length", length);
  RequireLength(problems, "width", width);
  RequireLength(problems, "slot", slot);
  RequireLength(problems, "height", height);
  problems.Require(!(slot >= length), "slot", slot, "must be below the length of the box");
}

void DrumOptions::Validate(base::Problems& problems) const {
  RequireLength(problems, "diameter", diameter);
  RequireLength(problems, "width", width);
  problems.Require(speed > 0 && std::isfinite(speed), "speed", speed, "must be positive");
  problems.Require(start_turns >= 0 && std::isfinite(start_turns), "start_turns", start_turns,
                   "must not be negative");
  problems.Require(turns > 0 && std::isfinite(turns), "turns", turns, "must be positive");
}

}  // namespace talus::rigs
