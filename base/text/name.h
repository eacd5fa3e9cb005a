// The one rule for the names that users give: of campaigns, experiments, parameters, candidates. A
// name becomes a column, a file's name, a line of a card, a word in a sentence.
#pragma once

#include <string>
#include <string_view>

#include "base/problems.h"

namespace talus::base {

// Refuses an empty name, one of more than 100 bytes, control characters, slashes, and a first
// character that a spreadsheet takes for a formula's.
void RequireName(Problems& problems, std::string_view path, std::string_view name);

// A text from outside, such as a file's name, in one line: control characters become spaces.
std::string OneLine(std::string_view text);

// A name as the stem of a file's: letters of any script and digits, with a dash for whatever else
// stands between.
std::string FileWord(std::string_view name);

}  // namespace talus::base
