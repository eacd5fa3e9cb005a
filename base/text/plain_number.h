// Numbers and shares in sentences, without powers of ten where a person would write none.
#pragma once

#include <string>

namespace talus::base {

// As ShortNumber; large ones whole: 120, not 1.2e+02.
std::string PlainNumber(double x, int digits);

// "12", "0.34", "less than 0.01"; without the sign.
std::string InPercent(double share);

}  // namespace talus::base
