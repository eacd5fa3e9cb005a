// What a quantity of a bench test can be. A value far outside has another unit than it was read
// with, and the text says which.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "base/problems.h"
#include "experiments/rigs/case/case.h"
#include "experiments/rigs/options/lifted_tube_options.h"
#include "experiments/rigs/options/rig_options.h"

namespace talus::rigs {

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

// What is wrong with the value [SI], to stand after "is 4.386, ": "in kg/m^3, must be from 25 to
// 25000; write "4.386 g/cm^3"". Empty where it can be, or is not positive.
std::string ImplausibleText(BenchQuantity quantity, double value);

// Adds that as a problem.
void RequirePlausible(BenchQuantity quantity, double value, std::string_view path,
                      base::Problems& problems);

// The same of what the grains of `powder` are, which stands at that key.
void RequirePlausibleGrains(const Powder& powder, base::Problems& problems);

// Of a tube and its plate, whose keys stand at `path`.
void RequirePlausibleTube(const LiftedTubeOptions& tube, const std::string& path,
                          base::Problems& problems);

// Speeds and angles of another rig, whose keys stand at `path`.
void RequirePlausibleRig(const RigOptions& rig, const std::string& path, base::Problems& problems);

// A typical diameter of the grains [m] and its key in `sizes`; 0 where a file or a table has it.
std::pair<const char*, double> TypicalDiameter(const engine::SizeDistribution& sizes);

}  // namespace talus::rigs
