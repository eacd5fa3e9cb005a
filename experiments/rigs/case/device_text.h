// A bulk test in the words of who makes it: which one, and what it is made with.
#pragma once

#include <string>

#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// "drum: diameter 84 mm, width 14 mm, speed 10 rpm": lengths, speeds and angles of the rig's own
// options.
std::string DeviceText(const Case& rig_case);

}  // namespace talus::rigs
