#include "imaging/photos/photo_set.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include "base/error.h"

namespace talus::imaging {
namespace {

constexpr std::size_t kLongestPattern = 255;  // as long as a file's name can be

// Numbers by value, before words.
struct ByNumber {
  static std::optional<unsigned long> Number(const std::string& text) {
    const bool digits =
        !text.empty() && text.size() <= 9 &&
        std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    return digits ? std::optional(std::stoul(text)) : std::nullopt;
  }
  bool operator()(const std::string& a, const std::string& b) const {
    const auto x = Number(a);
    const auto y = Number(b);
    if (x && y && *x != *y) return *x < *y;
    if (x.has_value() != y.has_value()) return x.has_value();
    return a < b;
  }
};

using Views = std::map<std::string, std::filesystem::path, ByNumber>;

// A pattern of file names. Not a regular expression: those take time that doubles with each `*`.
class Pattern {
 public:
  explicit Pattern(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const std::string_view rest = std::string_view(text).substr(i);
      if (rest.starts_with("{run}") && !has_run_) {
        has_run_ = true;
        parts_.push_back({.kind = kRun});
        i += 4;
      } else if (rest.starts_with("{view}") && !has_view_) {
        has_view_ = true;
        parts_.push_back({.kind = kView});
        i += 5;
      } else if (text[i] != '*') {
        parts_.push_back({.kind = kLetter, .letter = Lower(text[i])});
      } else if (parts_.empty() || parts_.back().kind != kAny) {
        parts_.push_back({.kind = kAny});
      }
    }
  }

  bool has_run() const { return has_run_; }
  bool has_view() const { return has_view_; }

  struct Match {
    std::string run;
    std::string view;
  };
  std::optional<Match> Fit(const std::string& name) const {
    Attempt attempt{.name = name, .failed = {}, .match = {}};
    attempt.failed.assign((name.size() + 1) * (parts_.size() + 1), false);
    if (!Fit(attempt, 0, 0)) return std::nullopt;
    return attempt.match;
  }

 private:
  enum Kind { kLetter, kAny, kRun, kView };
  struct Part {
    Kind kind = kLetter;
    char letter = 0;
  };
  struct Attempt {
    const std::string& name;
    std::vector<bool> failed;  // by part and place: each is tried once
    Match match;
  };

  static char Lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }

  // Whether the name from `at` on fits the parts from `part` on. `*` takes as much as it can,
  // {run} and {view} as little.
  bool Fit(Attempt& attempt, std::size_t part, std::size_t at) const {
    const std::size_t left = attempt.name.size() - at;
    if (part == parts_.size()) return left == 0;
    const std::size_t place = part * (attempt.name.size() + 1) + at;
    if (attempt.failed[place]) return false;
    const Part& p = parts_[part];
    bool fits = false;
    if (p.kind == kLetter) {
      fits = left > 0 && Lower(attempt.name[at]) == p.letter && Fit(attempt, part + 1, at + 1);
    } else if (p.kind == kAny) {  // one more letter, or no more
      fits = (left > 0 && Fit(attempt, part, at + 1)) || Fit(attempt, part + 1, at);
    } else {
      for (std::size_t n = 1; n <= left && !fits; ++n) {
        fits = Fit(attempt, part + 1, at + n);
        if (fits)
          (p.kind == kRun ? attempt.match.run : attempt.match.view) = attempt.name.substr(at, n);
      }
    }
    attempt.failed[place] = !fits;
    return fits;
  }

  std::vector<Part> parts_;
  bool has_run_ = false;
  bool has_view_ = false;
};

std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  std::filesystem::directory_iterator entry(folder, error);
  if (error) {
    throw base::ConfigError(folder.string() + ": cannot be read as a folder of photographs (" +
                            error.message() + ")");
  }
  for (const auto& file : entry) {
    // Pipes and dangling links are no photographs; a pipe that was opened would be waited for.
    if (file.is_regular_file(error)) files.push_back(file.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Every view that some run has, and those that a numbering in steps of one leaves out.
std::set<std::string, ByNumber> ExpectedViews(const std::map<std::string, Views, ByNumber>& runs) {
  std::set<std::string, ByNumber> expected;
  for (const auto& [run, views] : runs) {
    for (const auto& [view, path] : views) expected.insert(view);
  }
  std::set<std::string, ByNumber> gaps;
  bool by_one = false;
  std::optional<unsigned long> before;
  for (const std::string& view : expected) {
    const auto number = ByNumber::Number(view);
    if (!number) return expected;
    by_one |= before && *number == *before + 1;
    for (unsigned long gap = before.value_or(*number) + 1; gap < *number && gap < 10000; ++gap) {
      const std::string digits = std::to_string(gap);
      gaps.insert(std::string(view.size() - std::min(view.size(), digits.size()), '0') + digits);
    }
    before = number;
  }
  if (by_one && gaps.size() < expected.size()) expected.merge(gaps);
  return expected;
}

std::map<std::string, Views, ByNumber> Group(const std::vector<std::filesystem::path>& files,
                                             const std::string& pattern) {
  if (pattern.size() > kLongestPattern) {
    throw base::ConfigError("the pattern of the photographs' names has " +
                            std::to_string(pattern.size()) + " characters; give one of at most " +
                            std::to_string(kLongestPattern));
  }
  const Pattern compiled(pattern);
  std::map<std::string, Views, ByNumber> runs;
  std::map<std::string, int> counted;  // files of a run so far, for a pattern without {view}
  for (const std::filesystem::path& file : files) {
    const auto match = compiled.Fit(file.filename().string());
    if (!match) continue;
    const std::string run = compiled.has_run() ? match->run : "1";
    const std::string view = compiled.has_view() ? match->view : std::to_string(++counted[run]);
    const auto [entry, added] = runs[run].emplace(view, file);
    if (added) continue;
    throw base::ConfigError(file.string() + ": is view " + view + " of run " + run +
                            ", and so is " + entry->second.filename().string() +
                            "; make the pattern \"" + pattern + "\" tell them apart");
  }
  return runs;
}

}  // namespace

PhotoSet SortPhotos(const std::vector<std::filesystem::path>& files, const std::string& pattern) {
  const std::map<std::string, Views, ByNumber> runs = Group(files, pattern);
  PhotoSet set;
  const std::set<std::string, ByNumber> expected = ExpectedViews(runs);
  for (const auto& [run, views] : runs) {
    PhotoFiles of_run{.run = run, .views = {}};
    for (const std::string& view : expected) {
      const auto found = views.find(view);
      if (found != views.end()) {
        of_run.views.push_back({.view = view, .path = found->second});
      } else {
        set.missing.push_back("run " + run + " has no view " + view + " (pattern \"" + pattern +
                              "\")");
      }
    }
    set.runs.push_back(std::move(of_run));
  }
  return set;
}

PhotoSet FindPhotos(const std::filesystem::path& folder, const std::string& pattern) {
  PhotoSet set = SortPhotos(FilesOf(folder), pattern);
  if (set.runs.empty()) {
    throw base::ConfigError(folder.string() + ": no file matches the pattern \"" + pattern +
                            "\"; give the pattern of the photographs' names, such as "
                            "run{run}_view{view}.jpg");
  }
  for (std::string& missing : set.missing) missing = folder.string() + ": " + missing;
  return set;
}

}  // namespace talus::imaging
