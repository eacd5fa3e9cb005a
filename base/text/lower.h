// Text in small letters, for endings of files and heads of columns.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace talus::base {

// ASCII letters; other bytes stay as they are.
inline std::string Lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace talus::base
