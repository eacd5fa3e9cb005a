#include "base/json/json_text.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <string_view>

#include "base/text/printable.h"

namespace talus::base {
namespace {

bool IsPlain(char c) { return static_cast<unsigned char>(c) < 0x7f; }

// The library escapes the characters below U+0020 itself; of the others only a text can hold some.
std::string Escaped(const std::string& dumped) {
  std::string text;
  text.reserve(dumped.size());
  for (std::string_view rest = dumped; !rest.empty();) {
    const auto plain = std::find_if_not(rest.begin(), rest.end(), IsPlain) - rest.begin();
    text += rest.substr(0, static_cast<std::size_t>(plain));
    rest.remove_prefix(static_cast<std::size_t>(plain));
    const Character next = FirstCharacter(rest);
    assert(next.length > 0 || rest.empty());  // all is UTF-8 here
    if (next.is_control) {
      char code[11];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(next.code));
      text += code;
    } else {
      text += rest.substr(0, next.length);
    }
    rest.remove_prefix(next.length);
  }
  return text;
}

}  // namespace

std::string JsonText(const nlohmann::json& value, int indent) {
  return Escaped(value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string JsonText(const nlohmann::ordered_json& value, int indent) {
  return Escaped(value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace talus::base
