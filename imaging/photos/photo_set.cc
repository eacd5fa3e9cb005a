#include "imaging/photos/photo_set.h"

#include <algorithm>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <system_error>

#include "base/error.h"

namespace talus::imaging {
namespace {

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

// A pattern as a regular expression, with the numbers of its groups (0 when it has none).
struct Pattern {
  std::regex expression;
  std::size_t run_group = 0;
  std::size_t view_group = 0;
};

Pattern Compile(const std::string& pattern) {
  std::string expression;
  Pattern compiled;
  std::size_t groups = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const std::string rest = pattern.substr(i);
    if (rest.starts_with("{run}") && compiled.run_group == 0) {
      expression += "(.+?)";
      compiled.run_group = ++groups;
      i += 4;
    } else if (rest.starts_with("{view}") && compiled.view_group == 0) {
      expression += "(.+?)";
      compiled.view_group = ++groups;
      i += 5;
    } else if (pattern[i] == '*') {
      expression += ".*";
    } else {
      if (std::string_view("\\^$.|?+()[]{}").find(pattern[i]) != std::string_view::npos) {
        expression += '\\';
      }
      expression += pattern[i];
    }
  }
  compiled.expression = std::regex(expression, std::regex::icase);
  return compiled;
}

std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  std::filesystem::directory_iterator entry(folder, error);
  if (error) {
    throw base::ConfigError(folder.string() + ": cannot be read as a folder of photographs (" +
                            error.message() + ")");
  }
  for (const auto& file : entry) {
    if (!file.is_directory()) files.push_back(file.path());
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
  const Pattern compiled = Compile(pattern);
  std::map<std::string, Views, ByNumber> runs;
  std::map<std::string, int> counted;  // files of a run so far, for a pattern without {view}
  for (const std::filesystem::path& file : files) {
    std::smatch match;
    const std::string name = file.filename().string();
    if (!std::regex_match(name, match, compiled.expression)) continue;
    const std::string run = compiled.run_group > 0 ? match[compiled.run_group].str() : "1";
    const std::string view =
        compiled.view_group > 0 ? match[compiled.view_group].str() : std::to_string(++counted[run]);
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
