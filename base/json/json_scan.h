// Reads a JSON text once, front to back, and knows where it is: what the parser and the search for
// places share.
#pragma once

#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problems.h"

namespace talus::base {

// Where the parser's reading has come to. It looks one character ahead at the end of a number.
struct JsonPosition {
  std::string_view text;
  std::size_t taken = 0;           // characters read
  std::size_t line_start = 0;      // offset of the line of the last one read
  std::size_t previous_start = 0;  // of the line before
  int line = 1;

  void Take() {
    if (text[taken++] != '\n') return;
    previous_start = line_start;
    line_start = taken;
    ++line;
  }

  // Line and column of an offset in the line that is being read, or in the one before.
  Location At(std::size_t offset) const;

  // Where the token starts whose last character has just been read.
  std::size_t StringStart() const;
  std::size_t NumberStart() const { return StartOf("0123456789+-.eE"); }
  std::size_t WordStart() const { return StartOf("abcdefghijklmnopqrstuvwxyz"); }

 private:
  std::size_t StartOf(std::string_view letters) const;
};

// The parser's events without what none of ours needs.
class JsonEvents : public nlohmann::json::json_sax_t {
 public:
  bool binary(binary_t&) override { return false; }
};

// Feeds `events` with the text that `position` holds, from its start; false when one of them ended
// it or the text is no JSON.
bool ScanJson(JsonPosition& position, JsonEvents& events);

// Where the values of `paths` stand in a text that has been parsed.
std::vector<Location> FindJsonPlaces(std::string_view text, std::span<const std::string> paths);

}  // namespace talus::base
