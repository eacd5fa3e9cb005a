// A JSON file with comments that remembers where each of its values stands.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/problems.h"

namespace talus::base {

struct JsonFile {
  std::filesystem::path path;  // as given; relative paths inside the file start at its folder
  nlohmann::json root;
  SourceMap source;  // JSON path → line and column
};

// Comments (`//` and `/* */`) are allowed; a key given twice is an error. Both throw ConfigError
// with file, line and column.
JsonFile ReadJsonFile(const std::filesystem::path& path);
JsonFile ParseJson(std::string_view text, const std::filesystem::path& name);

}  // namespace talus::base
