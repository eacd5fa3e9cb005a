// Everything that is wrong with an input, collected so that a user sees it all at once.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace talus::base {

struct Location {
  int line = 0;           // from 1; 0 when unknown
  int column = 0;         // from 1
  std::string written{};  // the text that stands there, such as "5 cm"; empty for all other values
};

// Finds where the values of JSON paths such as `powder.sizes.classes[2].diameter` stand in their
// file, one for each path; a missing key has the place of the object that should hold it. Asked
// once, and only when there is something to report: a file without problems pays nothing for it.
using FindPlaces = std::function<std::vector<Location>(std::span<const std::string> paths)>;

struct Problem {
  std::string path;     // JSON path, empty for the file as a whole
  std::string message;  // what is wrong and what to do
  std::string value{};  // in SI, where the message is the rule that it breaks

  // "is 0.05 ("5 cm"), must be positive" of a value that is `written` with its unit.
  std::string Text(std::string_view written = {}) const;
};

// Collects problems while an input is read and validated, then throws them as one ConfigError.
class Problems {
 public:
  Problems() = default;
  Problems(std::string file, FindPlaces places)
      : file_(std::move(file)), places_(std::move(places)) {}

  // Adds a problem with the value at `path`, taken relative to the enclosing Within.
  void Add(std::string_view path, std::string message) {
    Add(Problem{.path = std::string(path), .message = std::move(message)});
  }
  // One that has been found elsewhere, under the path that it has here.
  void Add(Problem problem);

  // The same of a value that could not be read. What has its default meanwhile breaks no rule.
  void AddUnread(std::string_view path, std::string message);

  // Adds "is VALUE, RULE" unless `ok`; state what must hold, so that NaN fails too. Says nothing of
  // a value that has a problem already: one rule of a number that is broken is enough.
  void Require(bool ok, std::string_view path, double value, std::string_view rule);
  // The same in words, which may speak of several parts of what stands there: said of all but what
  // could not be read.
  void Require(bool ok, std::string_view path, std::string_view message);

  // A finite number above zero; nothing is asked of one that is not given.
  void RequirePositive(std::string_view path, std::optional<double> value);

  // A whole number from `low` to `high`, both included; nothing is asked of one that is not given.
  void RequireFromTo(std::string_view path, std::optional<int> value, int low, int high) {
    Require(!value || (*value >= low && *value <= high), path, value.value_or(0),
            "must be from " + std::to_string(low) + " to " + std::to_string(high));
  }

  // Runs `body` with `key` ("powder", "spheres[3]") put before every path it reports.
  template <class Body>
  void Within(std::string_view key, Body&& body) {
    const std::string outer = prefix_;
    prefix_ = FullPath(key);
    body();
    prefix_ = outer;
  }

  bool empty() const { return list_.empty(); }
  // The first kMostShown; of a million bad values nobody reads more.
  const std::vector<Problem>& list() const { return list_; }
  std::size_t size() const { return list_.size() + num_more_; }

  // Those of `list`, one a line: "spec.json:12:5: powder.density: is -1, must be positive", and how
  // many more there are.
  std::string Text() const;

  // Throws ConfigError(Text()) if there is any problem.
  void ThrowIfAny() const;

 private:
  static constexpr std::size_t kMostShown = 100;

  std::string FullPath(std::string_view path) const;

  std::string file_;
  FindPlaces places_;
  std::string prefix_;
  std::vector<Problem> list_;
  std::unordered_set<std::string> known_;   // paths that have a problem
  std::unordered_set<std::string> unread_;  // those of them that could not be read
  std::size_t num_more_ = 0;
};

}  // namespace talus::base
