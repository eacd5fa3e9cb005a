#include "base/text/name.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "base/text/printable.h"

namespace talus::base {
namespace {

// Or a digit; beyond ASCII whatever is no blank, no general punctuation, and obeyed by no terminal.
bool IsLetter(const Character& character) {
  if (character.length == 0 || character.is_control) return false;
  const std::uint32_t code = character.code;
  if (code < 0x80) return std::isalnum(static_cast<int>(code)) != 0;
  return code > 0xa0 && !(code >= 0x2000 && code < 0x2070) && code != 0x3000;
}

}  // namespace

void RequireName(Problems& problems, std::string_view path, std::string_view name) {
  constexpr std::size_t kLongest = 100;
  problems.Require(!name.empty() && name.size() <= kLongest, path,
                   "must have 1 to 100 bytes; choose another name");
  problems.Require(IsUtf8(name) && !HasControl(name), path,
                   "must be one line of UTF-8 without control characters");
  problems.Require(name.find_first_of("/\\") == std::string_view::npos, path,
                   "must have no slash, since files are named after it; write _ instead");
  problems.Require(
      name.empty() || std::string_view("=+-@").find(name.front()) == std::string_view::npos, path,
      "must not begin with =, +, - or @, which spreadsheets take for a formula");
}

std::string OneLine(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const Character character = FirstCharacter(text);
    const std::size_t length = character.length == 0 ? 1 : character.length;
    const bool shown = character.length > 0 && !character.is_control;
    line += shown ? std::string(text.substr(0, length)) : " ";
    text.remove_prefix(length);
  }
  return line;
}

std::string FileWord(std::string_view name) {
  std::string word;
  while (!name.empty()) {
    const Character character = FirstCharacter(name);
    const std::size_t length = std::max<std::size_t>(character.length, 1);
    if (IsLetter(character)) {
      word += name.substr(0, length);
    } else if (!word.empty() && word.back() != '-') {
      word += '-';
    }
    name.remove_prefix(length);
  }
  return word.empty() ? "test" : word;
}

}  // namespace talus::base
