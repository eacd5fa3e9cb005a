// JSON as text, the only printing of it. Values may hold the names and logs of others: bytes that
// are not UTF-8 become U+FFFD, and what a terminal would obey is escaped, so that the text is
// always JSON and never more than that.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace talus::base {

// In one line, or with `indent` spaces a level.
std::string JsonText(const nlohmann::json& value, int indent = -1);
std::string JsonText(const nlohmann::ordered_json& value, int indent = -1);

}  // namespace talus::base
