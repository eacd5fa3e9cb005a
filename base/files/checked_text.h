// A JSON text with its own checksum as its last key: a flipped bit is noticed, not read as another
// answer. It shows damage, not malice.
#pragma once

#include <optional>
#include <string>

namespace talus::base {

// `text` is an object that ends with a "}" and a line break. Its last key becomes "checksum_xxh3".
std::string WithChecksum(std::string text);

// The text that WithChecksum was given; nothing where there is no checksum at its end. Throws Error
// that begins with `name` when the two do not match.
std::optional<std::string> CheckedText(std::string text, const std::string& name);

// The same for what only counts when it is whole: nothing where the checksum is missing or wrong.
std::optional<std::string> IfWhole(std::string text);

}  // namespace talus::base
