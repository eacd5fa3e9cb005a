// "24 simulations, about 40 s of core time": what is about to be run, for people.
#pragma once

#include <string>

#include "base/text/counted.h"
#include "base/text/duration_text.h"

namespace talus::trials {

// `noun` in the singular; `core_time` of all together [s].
inline std::string WorkText(int count, const std::string& noun, double core_time) {
  return base::Counted(count, noun) + ", about " + base::DurationText(core_time) + " of core time";
}

}  // namespace talus::trials
