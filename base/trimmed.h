// Text without the blanks around it.
#pragma once

#include <string_view>

namespace talus::base {

// `blanks`: what counts as one; tables may have cells in quotes.
inline std::string_view Trimmed(std::string_view text, std::string_view blanks = " \t\r\n") {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace talus::base
