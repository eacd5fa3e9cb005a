#include "engine/scene/size_table.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "base/digit_groups.h"
#include "base/error.h"
#include "base/text/byte_order_mark.h"

namespace talus::engine {
namespace {

using Row = std::vector<std::string>;

// Lower case, and the micro signs of Latin-1 and Unicode as u. Q3 is not q3: the one is cumulative,
// the other a density.
std::string Plain(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    if ((byte == 0xC2 && next == 0xB5) || (byte == 0xCE && next == 0xBC)) {
      plain += 'u';
      ++i;
    } else if (byte == 0xB5) {
      plain += 'u';
    } else if (byte == 'Q' && std::isdigit(next)) {
      plain += 'Q';
    } else {
      plain += static_cast<char>(std::tolower(byte));
    }
  }
  return plain;
}

Row Split(std::string_view line, char separator) {
  Row fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) {
    field.erase(0, field.find_first_not_of(' '));
    field.erase(field.find_last_not_of(' ') + 1);
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

// A number with a point or a decimal comma; NaN for anything else.
double Number(std::string field) {
  std::replace(field.begin(), field.end(), ',', '.');
  if (!field.empty() && field.back() == '%') field.pop_back();
  double value = 0;
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  return result.ec == std::errc() && result.ptr == end && !field.empty() ? value : std::nan("");
}

// What a comma is in a column of numbers: between decimals, or between thousands as in "1,250".
struct Commas {
  std::optional<int> one_group;  // the line of a number that could be either, if any
  bool has_whole = false;        // another one has a point, or three digits and no comma
};

// "1,250", which may be a decimal as well.
bool MayBeGrouped(std::string_view field) {
  return base::IsGrouped(field, ',') && field.find(',') == field.rfind(',');
}

// As instruments write a share that is next to nothing.
bool IsNone(const std::string& field) {
  return field == "-" || (field.starts_with("<") && std::isfinite(Number(field.substr(1))));
}

// The size of what has passed every sieve, as tables of sieves write it.
bool IsPan(const std::string& field) {
  const bool is_below = field.starts_with("<") && std::isfinite(Number(field.substr(1)));
  return is_below || field == "pan" || field == "receiver" || field == "bottom" || field == "boden";
}

char SeparatorOf(std::string_view text) {
  const auto count = [&](char c) { return std::count(text.begin(), text.end(), c); };
  if (count(';') > 0) return ';';
  return count('\t') > 0 ? '\t' : ',';
}

std::vector<std::string> Lines(std::string_view text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

// Whether the numbers go on as the rows did: as many, and further in the same direction.
bool GoesOn(const std::vector<SizeRow>& rows, const std::vector<double>& numbers) {
  const double first = rows.front().numbers[0], last = rows.back().numbers[0];
  return numbers.size() == rows.back().numbers.size() &&
         (rows.size() < 2 || (numbers[0] - last) * (last - first) > 0);
}

std::size_t MostFields(const std::vector<Row>& rows) {
  std::size_t most = 0;
  for (const Row& row : rows) most = std::max(most, row.size());
  return most;
}

// The first block of lines that hold two numbers or more, and the line of titles above it. Blank
// lines part nothing. A line that begins with a number and has no second one may be the last, as an
// edge without a class.
class TableReader {
 public:
  TableReader(const std::filesystem::path& path, char separator)
      : path_(path), separator_(separator) {}

  // False where the block has ended.
  bool Take(const std::string& line) {
    ++line_number_;
    const Row fields = Split(line, separator_);
    if (fields.empty()) {
      is_apart_ = !table_.rows.empty();
      return true;
    }
    std::vector<double> numbers = NumbersOf(fields);
    const auto num_valid =
        std::count_if(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
    if (num_valid >= 2 && std::isfinite(numbers[0])) {
      AddRow(fields, std::move(numbers));
    } else if (!table_.rows.empty() && std::isfinite(numbers[0])) {
      if (!broken_) broken_ = line_number_;
    } else if (!table_.rows.empty()) {
      return false;
    } else if (fields.size() >= 2) {
      AddTitles(line, fields);
    }
    return true;
  }

  SizeTable Finished() {
    if (table_.rows.size() < 2) RefuseSizeFile(path_, "has no table of diameters and shares");
    const std::size_t num_columns = table_.rows.front().numbers.size();
    table_.titles.resize(num_columns);
    for (const Row& row : above_) {
      for (std::size_t c = 0; c < std::min(num_columns, row.size()); ++c) {
        table_.titles[c] += row[c] + ' ';
      }
    }
    if (!above_.empty()) table_.last_titles = above_.back();
    table_.last_titles.resize(num_columns);
    return std::move(table_);
  }

 private:
  static std::vector<double> NumbersOf(const Row& fields) {
    std::vector<double> numbers;
    for (const std::string& field : fields) {
      const bool is_zero = numbers.empty() ? IsPan(field) : IsNone(field);
      numbers.push_back(is_zero ? 0 : Number(field));
    }
    return numbers;
  }

  void AddTitles(const std::string& line, const Row& fields) {
    table_.title_line = line;
    if (above_.size() == 2) above_.erase(above_.begin());
    above_.push_back(fields);
  }

  void AddRow(const Row& fields, std::vector<double> numbers) {
    // A decimal comma between columns that commas part makes two fields of one.
    if (separator_ == ',' && !above_.empty() && fields.size() > MostFields(above_)) {
      RefuseLine(line_number_, "has " + std::to_string(fields.size()) + " fields below " +
                                   std::to_string(MostFields(above_)) +
                                   " titles; decimal commas are likely: part the columns with "
                                   "semicolons or tabs, or write decimal points; else give every "
                                   "column a title");
    }
    if (std::exchange(is_apart_, false) && !GoesOn(table_.rows, numbers)) {
      RefuseLine(line_number_, "a second table begins without a title; remove it");
    }
    for (std::size_t c = 0; c < fields.size(); ++c) {
      if (fields[c].empty()) numbers[c] = 0;  // as instruments write a class with nothing in it
      LookAtComma(fields[c], c);
    }
    if (broken_) {
      RefuseLine(*broken_, "has no share, and the table goes on below: complete or remove it");
    }
    table_.rows.push_back({std::move(numbers), line_number_});
  }

  void LookAtComma(const std::string& field, std::size_t column) {
    commas_.resize(std::max(commas_.size(), column + 1));
    Commas& commas = commas_[column];
    if (MayBeGrouped(field) && !commas.one_group) commas.one_group = line_number_;
    // Decimals of a cumulative share may end at a bare 100.
    commas.has_whole |= field.find('.') != std::string::npos ||
                        (field.size() >= 3 && field != "100" && base::AreDigits(field));
    if (!commas.one_group || !commas.has_whole) return;
    RefuseLine(*commas.one_group,
               "has a comma between thousands; write 1250, not 1,250, or decimals with a point");
  }

  [[noreturn]] void RefuseLine(int number, const std::string& why) const {
    RefuseSizeFile(path_, "line " + std::to_string(number) + ": " + why);
  }

  const std::filesystem::path& path_;
  char separator_;
  SizeTable table_;
  std::vector<Commas> commas_;  // by column
  std::vector<Row> above_;  // the last two lines of several fields above the numbers: the titles
  int line_number_ = 0;
  std::optional<int> broken_;  // a line without a share, by number
  bool is_apart_ = false;      // a blank line has been there
};

}  // namespace

void RefuseSizeFile(const std::filesystem::path& path, const std::string& why) {
  throw base::ConfigError(path.string() + ": " + why);
}

SizeTable ReadSizeTable(const std::string& text, const std::filesystem::path& path) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    RefuseSizeFile(path, "is UTF-16; export or save it as UTF-8");
  }
  const std::string plain = Plain(base::WithoutByteOrderMark(text));
  TableReader reader(path, SeparatorOf(plain));
  for (const std::string& line : Lines(plain)) {
    if (!reader.Take(line)) break;
  }
  return reader.Finished();
}

}  // namespace talus::engine
