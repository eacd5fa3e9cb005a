// Text in small letters, for endings of files, heads of columns and titles within sentences.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace talus::base {

// ASCII letters; other bytes stay as they are.
inline std::string Lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// A title within a sentence: "Mass fallen" is "mass fallen", "AOR 1" stays.
inline std::string LowerFirst(std::string title) {
  const bool is_abbreviation =
      title.size() > 1 && std::isupper(static_cast<unsigned char>(title[1])) != 0;
  if (!title.empty() && !is_abbreviation) {
    title.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(title.front())));
  }
  return title;
}

}  // namespace talus::base
