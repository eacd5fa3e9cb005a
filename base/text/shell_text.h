// Text for a shell: command lines that people paste, scripts, completions.
#pragma once

#include <string>
#include <string_view>

#include "base/replaced.h"

namespace talus::base {

// In single quotes, as a shell takes any text.
inline std::string ShellQuoted(std::string_view text) {
  return "'" + Replaced(text, "'", "'\\''") + "'";
}

// One word of a shell: in single quotes where it would not be taken as it is.
inline std::string ShellWord(std::string_view text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+=,:@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(text);
  }
  return ShellQuoted(text);
}

}  // namespace talus::base
