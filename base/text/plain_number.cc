#include "base/text/plain_number.h"

#include <cmath>

#include "base/text/number_text.h"

namespace talus::base {

std::string PlainNumber(double x, int digits) {
  constexpr int kWhole = 15;  // digits that a double has
  const bool is_large = std::abs(x) >= std::pow(10, digits) - 0.5;
  return is_large ? ShortNumber(std::round(x), kWhole) : ShortNumber(x, digits);
}

std::string InPercent(double share) {
  constexpr double kLeast = 0.01;
  const double percent = 100 * share;
  if (percent > 0 && percent < kLeast) return "less than " + ShortNumber(kLeast);
  return PlainNumber(percent, 2);
}

}  // namespace talus::base
