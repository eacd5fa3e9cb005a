#include "optimizer/answer/words.h"

#include <cstdio>

namespace talus::optimizer {
namespace {

std::string Print(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::string Rounded(double value) { return Print("%.3g", value); }
std::string Percent(double share) { return Print("%.1f %%", 100 * share); }

}  // namespace talus::optimizer
