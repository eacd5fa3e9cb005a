// A pattern of photographs' names: {run} and {view} stand for one or more characters, * for any,
// and none of them for a /, so that a pattern with folders sees as many of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace talus::imaging {

// Not a regular expression: those take time that doubles with each `*`. Upper and lower case are
// one.
class PhotoPattern {
 public:
  // Throws ConfigError for one that is longer than a file's name can be, and for a word in braces
  // that is unknown or stands twice: as letters of a name it would fit none.
  explicit PhotoPattern(const std::string& text);

  const std::string& text() const { return text_; }
  bool has_run() const { return has_run_; }
  bool has_view() const { return has_view_; }
  int num_folders() const { return num_folders_; }

  struct Match {
    std::string run;
    std::string view;
  };
  // `name` with as many folders before it as the pattern has.
  std::optional<Match> Fit(const std::string& name) const;

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

  bool Fit(Attempt& attempt, std::size_t part, std::size_t at) const;
  bool FitName(Attempt& attempt, std::size_t part, std::size_t at) const;

  std::string text_;
  std::vector<Part> parts_;
  bool has_run_ = false;
  bool has_view_ = false;
  int num_folders_ = 0;
};

}  // namespace talus::imaging
