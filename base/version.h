// Which version of the program wrote a file.
#pragma once

#include <string>

namespace talus::base {

// "0.1.0"
std::string Version();

// The commit that was built: "a1b2c3d4e5" or "a1b2c3d4e5-dirty"; "unknown" outside Git.
std::string Commit();

// "GCC 12.2.0"
std::string Compiler();

}  // namespace talus::base
