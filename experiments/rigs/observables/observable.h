// What bulk tests measure: one table, which the spec, the results, `next` and the report read.
//
// A new number is a value of the enum and a line of the table.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "base/not_known.h"
#include "base/units.h"

namespace talus::rigs {

enum class Observable {
  kMassOnPlate,
  kMassFallen,
  kNumFallen,
  kMassLeft,
  kBulkDensity,
  kPouredDensity,
  kTappedDensity,
  kHausnerRatio,
  kTappedSolidFraction,
  kRunout,
  kHeight,
  kColumnHeight,
  kAspectRatio,
  kDischargeTime,
  kDischargeRate,
  kAngle,
  kAngleSd,
  kShearAngle,
  kFlows,
  kReposeAngle1,
  kReposeAngle2,
  kReposeAngle3,
  kReposeTriangle,
  kStaticCohesiveIndex,
  kCohesiveIndex,
  kPackingFraction,
  kThickness,
  kCoverage,
  kRoughness,
  kLayerMass,
  kMassPerArea,
  kMassAhead,
  kSizeDrift,
  kShearStress1,
  kShearStress2,
  kShearStress3,
  kFrictionAngle,
  kCohesion
};
constexpr Observable LastOf(Observable) { return Observable::kCohesion; }

// The error that a careful laboratory reaches: of the value, or in the observable's unit.
struct UsualError {
  double relative = 0;  // [-]
  double absolute = 0;  // angles in degrees, the others in SI
};

// The error of a 0 or 1 that was seen once: the other one is four of them away, which is as good as
// excluded, and no observation less.
inline constexpr double kYesNoError = 0.25;

// What a number can be at all [SI]. A range that is predicted for it ends there: no run lies
// beyond.
struct Bounds {
  double low = 0;
  double high = std::numeric_limits<double>::infinity();

  double Clamp(double value) const { return std::clamp(value, low, high); }
};
inline constexpr Bounds kAnyNumber{.low = -std::numeric_limits<double>::infinity()};
inline constexpr Bounds kShare{.high = 1};
inline constexpr Bounds kInclination{.low = -std::numbers::pi / 2, .high = std::numbers::pi / 2};

struct ObservableInfo {
  Observable observable;
  const char* key = "";  // in a spec; the name in results has the unit, too
  base::Dimension dimension = base::Dimension::kNone;
  const char* title = "";  // in tables and figures
  const char* doc = "";    // how it is read
  UsualError usual_error{};
  Bounds bounds{};
  const char* method = "";  // in three words, where several are of one name
};

inline constexpr std::array kObservables = [] {
  using base::Dimension;
  using O = Observable;
  return std::to_array<ObservableInfo>({
      {O::kMassOnPlate, "mass_on_plate", Dimension::kMass, "Mass on the plate",
       "of the heap that stays on the plate"},
      {O::kMassFallen, "mass_fallen", Dimension::kMass, "Mass fallen",
       "of the powder that fell over the rim, or through the slot"},
      {O::kNumFallen, "num_fallen", Dimension::kNone, "Grains fallen",
       "number of the true grains that fell over the rim; a coarse one stands for scale_factor^3"},
      {O::kMassLeft, "mass_left", Dimension::kMass, "Mass left",
       "of the powder that stayed above the slot, or left the tilted box"},
      {O::kBulkDensity,
       "bulk_density",
       Dimension::kDensity,
       "Bulk density",
       "of the powder in the tube before the lift",
       {.relative = 0.01}},
      {O::kPouredDensity,
       "poured_density",
       Dimension::kDensity,
       "Poured density",
       "bulk density as poured",
       {.relative = 0.01}},
      {O::kTappedDensity,
       "tapped_density",
       Dimension::kDensity,
       "Tapped density",
       "bulk density after the taps",
       {.relative = 0.005}},
      {O::kHausnerRatio,
       "hausner_ratio",
       Dimension::kNone,
       "Hausner ratio",
       "tapped over poured density",
       {.relative = 0.01}},
      {O::kTappedSolidFraction,
       "tapped_solid_fraction",
       Dimension::kNone,
       "Tapped solid fraction",
       "share of the volume that the grains fill after the taps",
       {},
       kShare},
      {O::kRunout,
       "runout",
       Dimension::kLength,
       "Runout",
       "of the collapsed column, from its front",
       {.relative = 0.02}},
      {O::kHeight,
       "height",
       Dimension::kLength,
       "Height",
       "of the heap or the collapsed column",
       {.relative = 0.02}},
      {O::kColumnHeight, "column_height", Dimension::kLength, "Height of the column",
       "of the column before its gate opens"},
      {O::kAspectRatio, "aspect_ratio", Dimension::kNone, "Aspect ratio",
       "height over length of the column"},
      {O::kDischargeTime,
       "discharge_time",
       Dimension::kTime,
       "Discharge time",
       "until 95 % of what runs out has passed",
       {.relative = 0.02}},
      {O::kDischargeRate,
       "discharge_rate",
       Dimension::kMassRate,
       "Discharge rate",
       "through the slot or orifice",
       {.relative = 0.02}},
      {O::kAngle,
       "angle",
       Dimension::kAngle,
       "Angle",
       "of repose, sliding or the drum's surface (docs/rigs.md)",
       {.absolute = 1},
       kInclination},
      {O::kAngleSd, "angle_sd", Dimension::kAngle, "Angle, standard deviation",
       "of the drum's surface over time"},
      {O::kShearAngle,
       "shear_angle",
       Dimension::kAngle,
       "Shear angle",
       "of the slopes above the slot",
       {.absolute = 1},
       kInclination},
      {O::kFlows,
       "flows",
       Dimension::kNone,
       "Flows",
       "1 where powder runs through the orifice, 0 where an arch stands",
       {.absolute = kYesNoError},
       kShare},
      {O::kReposeAngle1,
       "angle_of_repose_1",
       Dimension::kAngle,
       "AOR 1",
       "of a round heap's silhouette by method 1 (docs/imaging.md)",
       {.absolute = 1},
       kInclination,
       "height over foot"},
      {O::kReposeAngle2,
       "angle_of_repose_2",
       Dimension::kAngle,
       "AOR 2",
       "the same by method 2",
       {.absolute = 1},
       kInclination,
       "line, whole slope"},
      {O::kReposeAngle3,
       "angle_of_repose_3",
       Dimension::kAngle,
       "AOR 3",
       "the same by method 3",
       {.absolute = 1},
       kInclination,
       "line, lower half"},
      {O::kReposeTriangle,
       "angle_of_repose_triangle",
       Dimension::kAngle,
       "AOR, triangle",
       "of the triangle of the silhouette's area on the plate's diameter",
       {.absolute = 1},
       kInclination,
       "from its area"},
      {O::kStaticCohesiveIndex, "heap_cohesive_index", Dimension::kNone, "Static cohesive index",
       "how far a round heap's outline is from that triangle, over its area (docs/imaging.md)"},
      {O::kCohesiveIndex, "cohesive_index", Dimension::kLength, "Cohesive index",
       "how much a drum's surface moves: the integral of its pictures' standard deviation over "
       "their area, over the diameter; needs rig.camera"},
      {O::kPackingFraction,
       "packing_fraction",
       Dimension::kNone,
       "Packing fraction",
       "of the spread layer: grains' volume over plate area times gap",
       {.relative = 0.03},
       kShare},
      {O::kThickness,
       "thickness",
       Dimension::kLength,
       "Thickness",
       "mean height of the spread layer's surface, bare places counted as 0",
       {.relative = 0.05}},
      {O::kCoverage,
       "coverage",
       Dimension::kNone,
       "Coverage",
       "share of the plate that grains hide from above",
       {.absolute = 0.02},
       kShare},
      {O::kRoughness,
       "roughness",
       Dimension::kLength,
       "Roughness",
       "standard deviation of the height of the spread layer's surface",
       {.relative = 0.1}},
      {O::kLayerMass,
       "layer_mass",
       Dimension::kMass,
       "Mass of the layer",
       "that the blade leaves on the plate, its ends included",
       {.relative = 0.02}},
      {O::kMassPerArea,
       "mass_per_area",
       Dimension::kAreaDensity,
       "Mass per area",
       "of the spread layer away from the plate's ends, as a piece cut out of its middle weighs",
       {.relative = 0.02}},
      {O::kMassAhead, "mass_ahead", Dimension::kMass, "Mass ahead",
       "of the blade when it has crossed the plate"},
      {O::kSizeDrift, "size_drift", Dimension::kNone, "Size drift",
       "mean diameter by volume at the end of the layer over that at its beginning"},
      {O::kShearStress1,
       "shear_stress_1",
       Dimension::kPressure,
       "Shear stress 1",
       "of a powder that shears steadily under the first of the shear cell's stresses",
       {.relative = 0.03}},
      {O::kShearStress2,
       "shear_stress_2",
       Dimension::kPressure,
       "Shear stress 2",
       "the same under the second",
       {.relative = 0.03}},
      {O::kShearStress3,
       "shear_stress_3",
       Dimension::kPressure,
       "Shear stress 3",
       "the same under the third",
       {.relative = 0.03}},
      {O::kFrictionAngle,
       "internal_friction_angle",
       Dimension::kAngle,
       "Angle of internal friction",
       "slope of the line through the shear stresses over the normal stresses",
       {.absolute = 1},
       kInclination},
      {O::kCohesion,
       "cohesion",
       Dimension::kPressure,
       "Cohesion",
       "shear stress of that line without a normal stress",
       {.absolute = 50},
       kAnyNumber},
  });
}();

constexpr const ObservableInfo& InfoOf(Observable observable) {
  return kObservables[static_cast<std::size_t>(observable)];
}

// How results write a dimension.
struct MetricUnit {
  const char* ending = "";  // of a metric's name: "_kg_per_m3"
  const char* text = "-";   // "kg/m3"
  double scale = 1;         // number in it / SI
};
MetricUnit MetricUnitOf(base::Dimension dimension);

// "mass_fallen_kg", its name in results.
std::string MetricName(Observable observable);

// The line of a name in results; none where another engine gave it a name of its own.
const ObservableInfo* FindObservable(std::string_view metric);

// "kg/m3" of "tapped_density_kg_per_m3", "-" of a ratio and of what is not in the table.
std::string UnitOfObservable(std::string_view metric);

// Bounds of a name in results, in its unit there; any number where it is not in the table.
Bounds BoundsOf(std::string_view metric);

// A number that a run has given.
struct Reading {
  Observable observable;
  double value = base::kNotKnown;  // in the metric's unit
  std::string undefined{};         // why it has no value; else empty
};

// A rig's observable; the usual ones are what `next` expects to be measured.
struct RigObservable {
  Observable observable;
  bool usual = false;
};

}  // namespace talus::rigs
