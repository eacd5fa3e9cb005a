// How wide a text is, as far as one character is as wide as another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace talus::base {

// Characters of a text in UTF-8, not its bytes: units and symbols are not ASCII.
inline std::size_t NumCharacters(std::string_view text) {
  const auto begins_one = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_one));
}

}  // namespace talus::base
