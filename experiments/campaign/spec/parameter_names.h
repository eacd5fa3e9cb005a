// The parameters that can be searched, by name.
#pragma once

#include <string>
#include <vector>

namespace talus::campaign {

// In the order of ParameterRanges.
std::vector<std::string> ParameterNames();

}  // namespace talus::campaign
