#include "base/text/duration_text.h"

#include <algorithm>

#include "base/text/number_text.h"

namespace talus::base {

std::string DurationText(double seconds) {
  if (seconds > 0 && seconds < 1) return ShortNumber(seconds, 1) + " s";
  const auto s = static_cast<long long>(std::max(0.0, seconds) + 0.5);
  if (s < 100) return std::to_string(s) + " s";
  if (s < 6000) return std::to_string((s + 30) / 60) + " min";
  return std::to_string(s / 3600) + " h " + std::to_string(s % 3600 / 60) + " min";
}

}  // namespace talus::base
