// Texts with placeholders, for the input decks of other engines.
//
//   {{ sliding_friction }}          a value
//   {{# grains }} … {{/ grains }}   its text once for each row of a table; the table's columns are
//                                   placeholders inside it. A tag alone on its line takes no line.
//   {{ "{{" }}                      two braces of the text's own
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/problems.h"

namespace talus::trials {

struct TemplateTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // a text for each column
};

struct TemplateValues {
  std::map<std::string, std::string, std::less<>> scalars;
  std::map<std::string, TemplateTable, std::less<>> tables;
};

// A text parted at its tags.
class TextTemplate {
 public:
  // Throws ConfigError "FILE:LINE: …" for a tag that is not closed or not a name.
  TextTemplate(std::string_view text, std::string file);

  // Reports, under the file's name, every name that `known` lacks, with the nearest one.
  void Check(const TemplateValues& known, base::Problems& problems) const;

  // The names of the values and tables that are used.
  std::set<std::string> Names() const;

  // Names must have been checked.
  std::string Fill(const TemplateValues& values) const;

 private:
  enum class Kind { kText, kBraces, kValue, kOpen, kClose };
  struct Part {
    Kind kind = Kind::kText;
    std::string text;  // or the name
    int line = 0;      // of a tag, from 1
    bool is_text() const { return kind == Kind::kText || kind == Kind::kBraces; }
  };
  void AddTag(std::string_view inner, int line);
  void DropLinesOfLoneTags();
  void CheckSections() const;
  std::string Place(const Part& part) const;
  std::string FillRows(std::size_t open, std::size_t close, const TemplateValues& values) const;

  std::string file_;
  std::vector<Part> parts_;
};

}  // namespace talus::trials
