// Records read back from the JSON that they were written as.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/json/json_reader.h"
#include "base/not_known.h"

namespace talus::journal {

// What is null was not defined when it was written: the field keeps its default, a number in a list
// is NaN.
inline void DropNulls(nlohmann::json& value) {
  if (value.is_object()) {
    for (auto it = value.begin(); it != value.end();) {
      it = it->is_null() ? value.erase(it) : std::next(it);
    }
  }
  if (value.is_structured()) {
    for (auto& element : value) {
      if (element.is_null()) element = base::kNotKnown;
      DropNulls(element);
    }
  }
}

// `name` is what an error calls the text. Throws ConfigError.
template <base::Visitable Record>
Record ParseRecord(const std::string& text, const std::string& name) {
  Record record;
  base::JsonFile file = base::ParseJson(text, name);
  DropNulls(file.root);
  base::Problems problems(name, file.places);
  base::ReadOptions(file.root, record, {problems, {}});
  problems.ThrowIfAny();
  return record;
}

}  // namespace talus::journal
