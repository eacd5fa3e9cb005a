// Lists as text.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace talus::base {

// "a, b, c" of what `text` makes of each element, or of what each has in the member `text`.
template <class List, class Text = std::identity>
std::string Joined(const List& list, std::string_view separator, Text text = {}) {
  std::string joined;
  bool is_first = true;
  for (const auto& element : list) {
    if (!is_first) joined += separator;
    joined += std::invoke(text, element);
    is_first = false;
  }
  return joined;
}

// The same of text(0) to text(count - 1).
template <class Text>
std::string JoinedUpTo(std::size_t count, std::string_view separator, Text text) {
  std::string joined;
  for (std::size_t i = 0; i < count; ++i) joined.append(i == 0 ? "" : separator).append(text(i));
  return joined;
}

// "a, b and c"
inline std::string Listed(const std::vector<std::string>& words) {
  return JoinedUpTo(words.size(), "", [&](std::size_t i) {
    return (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  });
}

}  // namespace talus::base
