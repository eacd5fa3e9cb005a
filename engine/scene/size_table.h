// The table of a size distribution as laser-diffraction instruments export it: some lines of head,
// then columns of numbers parted by commas, semicolons or tabs, with decimal points or decimal
// commas.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus::engine {

struct SizeRow {
  std::vector<double> numbers;  // NaN where a field is no number
  int line = 0;
};

struct SizeTable {
  std::string title_line;           // the last line of titles, in lower case
  std::vector<std::string> titles;  // of the columns, in lower case; units of a line below appended
  std::vector<std::string> last_titles;  // the same of the last line alone
  std::vector<SizeRow> rows;             // two at least
};

// The first block of lines with two numbers or more. Throws ConfigError that names the file, the
// line and the remedy.
SizeTable ReadSizeTable(const std::string& text, const std::filesystem::path& path);

// Throws ConfigError: the file, and why.
[[noreturn]] void RefuseSizeFile(const std::filesystem::path& path, const std::string& why);

}  // namespace talus::engine
