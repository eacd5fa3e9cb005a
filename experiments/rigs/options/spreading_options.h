// A blade, roller or comb that spreads a heap of powder over a build plate or a bed of powder, in a
// strip between two side walls.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/options/require.h"

namespace talus::rigs {

enum class Spreader { kBlade, kRoller, kComb };
constexpr Spreader LastOf(Spreader) { return Spreader::kComb; }

struct SpreadingOptions {
  Spreader spreader = Spreader::kBlade;
  std::optional<double> gap{};  // below the spreader [m], > 0; default: three D90 of the powder
  double speed = 0.05;          // of the spreader [m/s], > 0
  double length = 0.01;         // of the build plate along its path [m], > 0
  double width = 0.002;         // of the strip [m], > 0
  double feed = 0.004;          // length of the platform that the heap stands on [m], > 0
  std::optional<double> bed{};  // depth of the powder in the plate's place [m], > 0
  std::optional<double> roller_diameter{};  // [m], > 0; default: kRollerDiameter
  // The roller turns so fast [rad/s]; > 0: its lowest line runs ahead of it. Default: not at all.
  std::optional<double> turning{};
  std::optional<int> teeth{};            // of the comb [-], 1 to kMostTeeth; default: kTeeth
  std::optional<double> slot{};          // between two teeth [m], > 0; default: half of the pitch
  std::optional<double> tooth_length{};  // [m], > 0; default: the gap

  static constexpr double kRollerDiameter = 0.01;  // [m]
  static constexpr int kTeeth = 4;
  static constexpr int kMostTeeth = 50;

  double RollerRadius() const { return roller_diameter.value_or(kRollerDiameter) / 2; }
  double Pitch() const { return width / teeth.value_or(kTeeth); }  // of the comb [m]
  double Slot() const { return slot.value_or(Pitch() / 2); }       // [m]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("spreader", self.spreader, {.doc = "what spreads the powder"});
    visit("gap", self.gap,
          {.dimension = Dimension::kLength,
           .doc = "between spreader and ground, > 0; default: three D90 of the true powder"});
    visit("speed", self.speed,
          {.dimension = Dimension::kVelocity, .doc = "of the spreader along its path, > 0"});
    visit("length", self.length,
          {.dimension = Dimension::kLength, .doc = "of the build plate along the path, > 0"});
    visit("width", self.width,
          {.dimension = Dimension::kLength, .doc = "of the strip between its side walls, > 0"});
    visit("feed", self.feed,
          {.dimension = Dimension::kLength,
           .doc = "length of the platform that the heap stands on before the plate, > 0"});
    visit("bed", self.bed,
          {.dimension = Dimension::kLength,
           .doc = "depth of a level bed of the same powder in the plate's place, > 0; default: a "
                  "bare plate"});
    visit("roller_diameter", self.roller_diameter,
          {.dimension = Dimension::kLength, .doc = "of a roller, > 0; default: 10 mm"});
    visit(
        "turning", self.turning,
        {.dimension = Dimension::kAngularVelocity,
         .doc = "of a roller; above 0 its lowest line runs ahead of it, as in most machines, below "
                "0 it lags behind; default: it does not turn"});
    visit("teeth", self.teeth, {.doc = "of a comb, 1 to 50; default: 4"});
    visit("slot", self.slot,
          {.dimension = Dimension::kLength,
           .doc = "between two teeth of a comb, > 0; default: as wide as a tooth"});
    visit("tooth_length", self.tooth_length,
          {.dimension = Dimension::kLength, .doc = "of a comb, > 0; default: the gap"});
  }
  void Validate(base::Problems& problems) const {
    if (gap) RequireLength(problems, "gap", *gap);
    problems.RequirePositive("speed", speed);
    RequireLength(problems, "length", length);
    RequireLength(problems, "width", width);
    RequireLength(problems, "feed", feed);
    if (bed) RequireLength(problems, "bed", *bed);
    ValidateRoller(problems);
    ValidateComb(problems);
  }

 private:
  void RequireSpreader(base::Problems& problems, bool given, const char* key,
                       Spreader owner) const {
    const std::string name(base::NameOf(owner));
    problems.Require(!given || spreader == owner, key,
                     "is a " + name + "'s: add \"spreader\": \"" + name + "\", or remove it");
  }

  void ValidateRoller(base::Problems& problems) const {
    RequireSpreader(problems, roller_diameter.has_value(), "roller_diameter", Spreader::kRoller);
    RequireSpreader(problems, turning.has_value(), "turning", Spreader::kRoller);
    if (roller_diameter) RequireLength(problems, "roller_diameter", *roller_diameter);
    problems.Require(!turning || std::isfinite(*turning), "turning", turning.value_or(0),
                     "must be finite");
  }

  void ValidateComb(base::Problems& problems) const {
    RequireSpreader(problems, teeth.has_value(), "teeth", Spreader::kComb);
    RequireSpreader(problems, slot.has_value(), "slot", Spreader::kComb);
    RequireSpreader(problems, tooth_length.has_value(), "tooth_length", Spreader::kComb);
    problems.RequireFromTo("teeth", teeth, 1, kMostTeeth);
    if (slot) RequireLength(problems, "slot", *slot);
    if (tooth_length) RequireLength(problems, "tooth_length", *tooth_length);
    if (teeth && *teeth < 1) return;
    problems.Require(!slot || *slot < Pitch(), "slot", slot.value_or(0),
                     "leaves nothing of the teeth: must be below the width over their number");
  }
};

}  // namespace talus::rigs
