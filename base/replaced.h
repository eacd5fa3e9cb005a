// A text with another in place of a part, wherever that part stands.
#pragma once

#include <string>
#include <string_view>

namespace talus::base {

// `from` is not empty. What has been put in is not searched again.
inline std::string Replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result;
  for (auto at = text.find(from); at != std::string_view::npos; at = text.find(from)) {
    result += text.substr(0, at);
    result += to;
    text.remove_prefix(at + from.size());
  }
  return result += text;
}

}  // namespace talus::base
