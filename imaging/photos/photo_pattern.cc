#include "imaging/photos/photo_pattern.h"

#include <cctype>
#include <string_view>

#include "base/error.h"

namespace talus::imaging {
namespace {

constexpr std::size_t kLongestPattern = 255;

// `rest` begins with a brace.
[[noreturn]] void ThrowUnknownWord(const std::string& pattern, std::string_view rest) {
  const std::string word(rest.substr(0, rest.find('}') + 1));
  const bool is_known = word == "{run}" || word == "{view}";
  throw base::ConfigError("the pattern \"" + pattern + "\" of the photographs' names has " + word +
                          (is_known ? " twice; write * for what may differ"
                                    : ", which is unknown; write {run} and {view} for numbers or "
                                      "words, * for anything"));
}

char Lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

PhotoPattern::PhotoPattern(const std::string& text) : text_(text) {
  if (text.size() > kLongestPattern) {
    throw base::ConfigError("the pattern of the photographs' names has " +
                            std::to_string(text.size()) + " characters; give one of at most " +
                            std::to_string(kLongestPattern));
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = std::string_view(text).substr(i);
    num_folders_ += text[i] == '/';
    if (rest.starts_with("{run}") && !has_run_) {
      has_run_ = true;
      parts_.push_back({.kind = kRun});
      i += 4;
    } else if (rest.starts_with("{view}") && !has_view_) {
      has_view_ = true;
      parts_.push_back({.kind = kView});
      i += 5;
    } else if (text[i] == '{' && rest.find('}') != std::string_view::npos) {
      ThrowUnknownWord(text, rest);
    } else if (text[i] != '*') {
      parts_.push_back({.kind = kLetter, .letter = Lower(text[i])});
    } else if (parts_.empty() || parts_.back().kind != kAny) {
      parts_.push_back({.kind = kAny});
    }
  }
}

std::optional<PhotoPattern::Match> PhotoPattern::Fit(const std::string& name) const {
  Attempt attempt{.name = name, .failed = {}, .match = {}};
  attempt.failed.assign((name.size() + 1) * (parts_.size() + 1), false);
  if (!Fit(attempt, 0, 0)) return std::nullopt;
  return attempt.match;
}

// Whether the name from `at` on fits the parts from `part` on. `*` takes as much as it can, {run}
// and {view} as little.
bool PhotoPattern::Fit(Attempt& attempt, std::size_t part, std::size_t at) const {
  const std::size_t left = attempt.name.size() - at;
  if (part == parts_.size()) return left == 0;
  const std::size_t place = part * (attempt.name.size() + 1) + at;
  if (attempt.failed[place]) return false;
  const Part& p = parts_[part];
  bool fits = false;
  if (p.kind == kLetter) {
    fits = left > 0 && Lower(attempt.name[at]) == p.letter && Fit(attempt, part + 1, at + 1);
  } else if (p.kind == kAny) {  // one more letter, or no more
    fits = (left > 0 && attempt.name[at] != '/' && Fit(attempt, part, at + 1)) ||
           Fit(attempt, part + 1, at);
  } else {
    fits = FitName(attempt, part, at);
  }
  attempt.failed[place] = !fits;
  return fits;
}

bool PhotoPattern::FitName(Attempt& attempt, std::size_t part, std::size_t at) const {
  for (std::size_t n = 1; at + n <= attempt.name.size(); ++n) {
    if (attempt.name[at + n - 1] == '/') return false;
    if (!Fit(attempt, part + 1, at + n)) continue;
    (parts_[part].kind == kRun ? attempt.match.run : attempt.match.view) =
        attempt.name.substr(at, n);
    return true;
  }
  return false;
}

}  // namespace talus::imaging
