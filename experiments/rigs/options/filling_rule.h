// How the powder gets into the tube.
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "base/problems.h"

namespace talus::rigs {

// kDense: placed at rest, at a solid fraction of 0.55, in no simulated time. kPour: from the mouth
// of a funnel, grain by grain.
enum class FillingKind { kDense, kPour };
constexpr FillingKind LastOf(FillingKind) { return FillingKind::kPour; }

// Before the lift, plate and tube are lifted together and let fall.
struct TapRule {
  int count = 0;          // > 0
  double height = 1e-3;   // of each fall [m], > 0
  double interval = 0.1;  // from tap to tap [s], above the time that one takes

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("count", self.count, {.required = true, .doc = "> 0"});
    visit("height", self.height, {.dimension = Dimension::kLength, .doc = "of each fall, > 0"});
    visit("interval", self.interval,
          {.dimension = Dimension::kTime,
           .doc = "from tap to tap; above three times the time of the fall"});
  }
  void Validate(base::Problems& problems) const {
    problems.RequirePositive("count", count);
    problems.RequirePositive("height", height);
    problems.RequirePositive("interval", interval);
  }
};

struct FillingRule {
  FillingKind kind = FillingKind::kDense;
  std::optional<double> drop_height{};     // of the mouth above the powder [m], > 0: pour
  std::optional<double> mouth_diameter{};  // [m], > 0: pour
  std::optional<double> rate{};            // [kg/s], > 0: pour
  std::optional<double> scatter{};         // [m/s], >= 0: pour
  std::optional<TapRule> taps{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("kind", self.kind,
          {.doc = "dense: placed at rest without overlaps; pour: from a funnel's mouth"});
    visit("drop_height", self.drop_height,
          {.dimension = Dimension::kLength,
           .doc = "pour: of the mouth above the powder, which it follows; default: half the tube's "
                  "diameter"});
    visit("mouth_diameter", self.mouth_diameter,
          {.dimension = Dimension::kLength,
           .doc = "pour: default: 0.6 of the tube's or four of the largest grains, at most 0.9 of "
                  "the tube's"});
    visit("rate", self.rate,
          {.dimension = Dimension::kMassRate,
           .doc = "pour: default: as fast as a funnel of this mouth empties"});
    visit("scatter", self.scatter,
          {.dimension = Dimension::kVelocity,
           .doc = "pour: largest velocity across the stream; default: 0"});
    visit("taps", self.taps, {.doc = "of the filled tube, before it is lifted; default: none"});
  }
  void Validate(base::Problems& problems) const {
    const auto check = [&](const char* key, const std::optional<double>& value) {
      if (!value) return;
      problems.Require(kind == FillingKind::kPour, key, "belongs to the kind pour; remove it");
      if (std::string_view(key) == "scatter") {
        problems.Require(*value >= 0 && std::isfinite(*value), key, *value, "must not be negative");
      } else {
        problems.RequirePositive(key, *value);
      }
    };
    check("drop_height", drop_height);
    check("mouth_diameter", mouth_diameter);
    check("rate", rate);
    check("scatter", scatter);
  }
};

}  // namespace talus::rigs
