// A JSON file with comments, and where each of its values stands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/problems.h"

namespace talus::base {

struct JsonFile {
  std::filesystem::path path;  // as given; relative paths inside the file start at its folder
  nlohmann::json root;
  FindPlaces places;  // JSON path → line and column
};

// Comments (`//` and `/* */`) are allowed. A key given twice, more than 100 levels of nesting and a
// number that no double holds are errors; each throws ConfigError with file, line and column.
// Linear in time and memory, whatever the text.
JsonFile ReadJsonFile(const std::filesystem::path& path);
JsonFile ParseJson(std::string_view text, const std::filesystem::path& name);

// The text at a key; empty when there is none, or something else.
std::string TextAt(const nlohmann::json& object, const std::string& key);

// The whole number at a key; 0 when there is none, or something else.
std::int64_t IntegerAt(const nlohmann::json& object, const std::string& key);

}  // namespace talus::base
