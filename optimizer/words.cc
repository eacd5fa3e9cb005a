#include "optimizer/words.h"

#include <cstdio>

#include "base/text/number_text.h"

namespace talus::optimizer {

std::string Rounded(double value) { return base::ShortNumber(value, 3); }

std::string Percent(double share) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}

}  // namespace talus::optimizer
