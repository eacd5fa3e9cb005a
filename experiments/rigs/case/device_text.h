// A bulk test in the words of who makes it: which one, and what it is made with.
#pragma once

#include <string>

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// "84 mm", "10 rpm", "10 deg/s", "33 deg": in the unit of the bench, as inputs may have it; empty
// for what is no length, speed, angle, time or stress.
std::string QuantityText(double value, base::Dimension dimension);

// "drum: diameter 84 mm, width 14 mm, speed 10 rpm": lengths, speeds, angles, times and stresses of
// the rig's own options.
std::string DeviceText(const RigOptions& rig);

}  // namespace talus::rigs
