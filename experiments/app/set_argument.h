// NAME=VALUE… on the command line: a parameter set.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/error.h"

namespace talus::app {

// Throws ConfigError for another form, and for a name that is given twice.
inline std::map<std::string, std::string> ReadSetArgument(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> set;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
      throw base::ConfigError("\"" + text + "\": must be NAME=VALUE, as sliding_friction=0.45");
    }
    if (!set.emplace(text.substr(0, equals), text.substr(equals + 1)).second) {
      throw base::ConfigError(text.substr(0, equals) + ": is given twice");
    }
  }
  return set;
}

}  // namespace talus::app
