// What a quantity of a bench test can be. A value far outside has another unit than it was read
// with, and the text says which.
#pragma once

#include <string>

#include "base/units.h"

namespace talus::campaign {

enum class BenchQuantity {
  kGrainDensity,
  kGrainDiameter,  // median
  kTubeDiameter,
  kPlateDiameter,
  kLiftVelocity,
  kMass,
  kYoungsModulus,
  kSurfaceEnergy
};

inline constexpr double kFastest = 5;  // part of a rig [m/s]

base::Dimension DimensionOf(BenchQuantity quantity);

// What is wrong with the value [SI], to stand after "is 4.386, ": "in kg/m^3, must be from 25 to
// 25000; write "4.386 g/cm^3"". Empty where it can be, or is not positive.
std::string ImplausibleText(BenchQuantity quantity, double value);

}  // namespace talus::campaign
