#include "base/text/name.h"

#include <cctype>

#include "base/text/printable.h"

namespace talus::base {

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
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      word += c;
    } else if (!word.empty() && word.back() != '-') {
      word += '-';
    }
  }
  return word.empty() ? "test" : word;
}

}  // namespace talus::base
