// Which version of the program wrote a file.
#pragma once

#include <string>

namespace talus::base {

// "0.1.0"
std::string Version();

}  // namespace talus::base
