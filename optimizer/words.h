// Numbers in the sentences that strategies write for people.
#pragma once

#include <cstdio>
#include <string>

#include "base/text/number_text.h"

namespace talus::optimizer {

inline std::string Rounded(double value) { return base::ShortNumber(value, 3); }

// 0.123 as "12.3 %".
inline std::string Percent(double share) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}

}  // namespace talus::optimizer
