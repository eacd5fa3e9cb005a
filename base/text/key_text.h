// Keys of files as people read them.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

namespace talus::base {

struct KeyText {
  std::string_view key;
  std::string_view text;
};

// What the list has for a key; one that is not in it stays as it is.
inline std::string TextOf(std::span<const KeyText> list, std::string_view key) {
  const auto found = std::ranges::find(list, key, &KeyText::key);
  return std::string(found == list.end() ? key : found->text);
}

// "rolling_friction" → "rolling friction"
inline std::string Spaced(std::string_view key) {
  std::string text(key);
  std::ranges::replace(text, '_', ' ');
  return text;
}

}  // namespace talus::base
