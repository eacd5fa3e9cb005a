// Numbers in the sentences that strategies write for people.
#pragma once

#include <string>

namespace talus::optimizer {

std::string Rounded(double value);  // three significant digits
std::string Percent(double share);  // 0.123 as "12.3 %"

}  // namespace talus::optimizer
