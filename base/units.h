// Quantities as people write them: "45 um", "1.5 g", "1 cm/s", "26.25 MPa", "40e-5 J/m^2".
#pragma once

#include <numbers>
#include <string>
#include <string_view>

namespace talus::base {

inline constexpr double kDegree = std::numbers::pi / 180;  // [rad]

// What a number measures; it decides which units a text may carry.
enum class Dimension {
  kNone,
  kLength,           // m
  kMass,             // kg
  kTime,             // s
  kVelocity,         // m/s
  kAcceleration,     // m/s²
  kAngularVelocity,  // rad/s
  kAngle,            // rad
  kDensity,          // kg/m³
  kPressure,         // Pa
  kSurfaceEnergy,    // J/m²
  kEnergy,           // J
  kMassRate,         // kg/s
  kAreaDensity,      // kg/m²
};

// The SI unit's symbol as it is written in an input: "m", "kg/m^3"; "" for kNone.
std::string_view SiUnit(Dimension dimension);

// "g/mL" of "0.64 g/mL", as it is typed; "" of a bare number and of what is none.
std::string_view UnitIn(std::string_view text);

// Whether a text is a number without a unit.
bool IsBareNumber(std::string_view text);

// "45 um" → 4.5e-5. A bare number is taken to be in SI. Throws ConfigError that names the text and
// the units that fit.
double ParseQuantity(std::string_view text, Dimension dimension);

}  // namespace talus::base
