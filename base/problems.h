// Everything that is wrong with an input, collected so that a user sees it all at once.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace talus::base {

struct Location {
  int line = 0;    // from 1; 0 when unknown
  int column = 0;  // from 1
};

// JSON path such as `powder.sizes.classes[2].diameter` → where that value stands in its file.
using SourceMap = std::map<std::string, Location, std::less<>>;

struct Problem {
  std::string path;     // JSON path, empty for the file as a whole
  std::string message;  // what is wrong and what to do
};

// Collects problems while an input is read and validated, then throws them as one ConfigError.
class Problems {
 public:
  Problems() = default;
  Problems(std::string file, SourceMap source)
      : file_(std::move(file)), source_(std::move(source)) {}

  // Adds a problem with the value at `path`, taken relative to the enclosing Within.
  void Add(std::string_view path, std::string message);

  // Adds "is VALUE, RULE" unless `ok`; state what must hold, so that NaN fails too. Says nothing of
  // a value that has a problem already: one that could not be read still has its default.
  void Require(bool ok, std::string_view path, double value, std::string_view rule);
  void Require(bool ok, std::string_view path, std::string_view message);

  // Runs `body` with `key` ("powder", "spheres[3]") put before every path it reports.
  template <class Body>
  void Within(std::string_view key, Body&& body) {
    const std::string outer = prefix_;
    prefix_ = FullPath(key);
    body();
    prefix_ = outer;
  }

  bool empty() const { return list_.empty(); }
  const std::vector<Problem>& list() const { return list_; }

  // All problems, one a line: "spec.json:12:5: powder.density: is -1, must be positive".
  std::string Text() const;

  // Throws ConfigError(Text()) if there is any problem.
  void ThrowIfAny() const;

 private:
  std::string FullPath(std::string_view path) const;
  Location Find(std::string_view path) const;

  std::string file_;
  SourceMap source_;
  std::string prefix_;
  std::vector<Problem> list_;
};

}  // namespace talus::base
