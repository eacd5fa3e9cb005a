// "1 run", "2 runs": a count with its noun.
#pragma once

#include <string>

namespace talus::base {

inline std::string Counted(long long count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace talus::base
