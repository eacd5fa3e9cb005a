// Durations as people say them.
#pragma once

#include <string>

namespace talus::base {

// "45 s", "12 min", "3 h 20 min"
std::string DurationText(double seconds);

}  // namespace talus::base
