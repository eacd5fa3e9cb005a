// Digits, and numbers whose thousands are parted.
#pragma once

#include <algorithm>
#include <string_view>

namespace talus::base {

inline bool IsDigit(char c) { return c >= '0' && c <= '9'; }

inline bool AreDigits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, IsDigit);
}

// "1,602" and "12,345,678" with a comma between the groups: one to three digits, no zero first,
// then three each.
inline bool IsGrouped(std::string_view whole, char separator) {
  constexpr std::size_t kGroup = 3;
  const std::size_t first = whole.find(separator);
  if (first == std::string_view::npos || first > kGroup || !AreDigits(whole.substr(0, first)) ||
      whole.front() == '0') {
    return false;
  }
  for (std::size_t at = first; at < whole.size(); at += kGroup + 1) {
    const std::string_view group = whole.substr(at + 1, kGroup);
    if (whole[at] != separator || group.size() != kGroup || !AreDigits(group)) return false;
  }
  return true;
}

}  // namespace talus::base
