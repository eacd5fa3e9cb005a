// Size distributions as laser-diffraction instruments export them: some lines of head, then columns
// of which one is a diameter and one a share, cumulative or of each class.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/text/byte_order_mark.h"
#include "base/units.h"
#include "engine/scene/size_distribution.h"

namespace talus::engine {
namespace {

using Row = std::vector<std::string>;

constexpr std::uint64_t kLargestSizeFile = 16u << 20;  // [bytes]; instruments write some kB

struct TableRow {
  std::vector<double> numbers;  // NaN where a field is no number
  int line = 0;
};

struct Table {
  std::string title_line;  // the last line of titles, in lower case
  Row titles;              // of the columns, in lower case; units of a line below appended
  std::vector<TableRow> rows;
};

[[noreturn]] void Refuse(const std::filesystem::path& path, const std::string& why) {
  throw base::ConfigError(path.string() + ": " + why);
}

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

// As instruments write a share that is next to nothing.
bool IsNone(const std::string& field) {
  return field == "-" || (field.starts_with("<") && std::isfinite(Number(field.substr(1))));
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
bool GoesOn(const std::vector<TableRow>& rows, const std::vector<double>& numbers) {
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

  Table Finished() {
    if (table_.rows.size() < 2) Refuse(path_, "has no table of diameters and shares");
    const std::size_t num_columns = table_.rows.front().numbers.size();
    table_.titles.resize(num_columns);
    for (const Row& row : above_) {
      for (std::size_t c = 0; c < std::min(num_columns, row.size()); ++c) {
        table_.titles[c] += row[c] + ' ';
      }
    }
    return std::move(table_);
  }

 private:
  static std::vector<double> NumbersOf(const Row& fields) {
    std::vector<double> numbers;
    for (const std::string& field : fields) {
      numbers.push_back(!numbers.empty() && IsNone(field) ? 0 : Number(field));
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
    }
    if (broken_) {
      RefuseLine(*broken_, "has no share, and the table goes on below: complete or remove it");
    }
    table_.rows.push_back({std::move(numbers), line_number_});
  }

  [[noreturn]] void RefuseLine(int number, const std::string& why) const {
    Refuse(path_, "line " + std::to_string(number) + ": " + why);
  }

  const std::filesystem::path& path_;
  char separator_;
  Table table_;
  std::vector<Row> above_;  // the last two lines of several fields above the numbers: the titles
  int line_number_ = 0;
  std::optional<int> broken_;  // a line without a share, by number
  bool is_apart_ = false;      // a blank line has been there
};

Table ReadTable(std::string text, const std::filesystem::path& path) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    Refuse(path, "is UTF-16; export or save it as UTF-8");
  }
  const std::string plain = Plain(base::WithoutByteOrderMark(text));
  TableReader reader(path, SeparatorOf(plain));
  for (const std::string& line : Lines(plain)) {
    if (!reader.Take(line)) break;
  }
  return reader.Finished();
}

bool HasAny(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

bool IsLetter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalpha(byte) || byte >= 0x80;  // what follows the first byte of a Greek letter, too
}

// Whether one of the words begins where no other word goes on: "less", but not "dimensionless".
bool BeginsWithAny(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) {
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      if (at == 0 || !IsLetter(text[at - 1])) return true;
    }
    return false;
  });
}

// Whether the word stands alone somewhere: "size", but not "undersize".
bool HasWord(const std::string& text, const std::string& word) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !IsLetter(text[at - 1])) && (end == text.size() || !IsLetter(text[end]))) {
      return true;
    }
  }
  return false;
}

// [m]
std::optional<double> UnitIn(const std::string& text) {
  for (const char* unit : {"um", "nm", "mm"}) {
    if (HasWord(text, unit)) {
      return base::ParseQuantity(std::string("1 ") + unit, base::Dimension::kLength);
    }
  }
  if (BeginsWithAny(text, {"micron"})) return 1e-6;
  if (HasAny(text, {"(m)", "[m]", "/m "})) return 1;
  return std::nullopt;
}

double UnitOf(const std::filesystem::path& path, const std::string& title,
              const std::string& title_line) {
  for (const std::string& text : {title, title_line}) {
    if (const std::optional<double> unit = UnitIn(text)) return *unit;
  }
  Refuse(path,
         "does not say in which unit the diameters are; write it into the head of their "
         "column, such as \"diameter (um)\"");
}

bool IsOfCoarser(const std::string& title) {
  return HasAny(title, {"over", ">", "retained", "coarser"});
}
bool IsOfFiner(const std::string& title) {
  return !IsOfCoarser(title) &&
         (HasAny(title, {"under", "cum", "passing", "finer", "<", "sum", "durchgang"}) ||
          BeginsWithAny(title, {"Q3", "Q0", "below", "less"}));
}
// Per length, or per decade: no share of a class.
bool IsDensity(const std::string& title) {
  return BeginsWithAny(title, {"q3", "q0"}) && title.find('%') == std::string::npos;
}
bool IsOfDiameters(const std::string& title) {
  const bool is_share = IsOfCoarser(title) ||
                        HasAny(title, {"%", "under", "passing", "finer", "durchgang"}) ||
                        BeginsWithAny(title, {"percent", "share", "cum", "Q3", "Q0", "q3", "q0"});
  return !is_share &&
         (HasAny(title, {"diameter", "particle", "channel", "sieve", "mesh"}) ||
          HasWord(title, "size") ||
          BeginsWithAny(title, {"x0", "xu", "d ", "x ", "d[", "x[", "d(", "x(", "d/", "x/"}));
}

struct Columns {
  std::size_t diameter = 0;
  std::size_t share = 1;
  bool cumulative = false;
};

Columns Find(const std::filesystem::path& path, const Table& table) {
  const auto find = [&](auto&& fits) {
    std::size_t c = 0;
    while (c < table.titles.size() && !fits(table.titles[c])) ++c;
    return c;
  };
  const std::size_t num_columns = table.titles.size();
  Columns columns;
  columns.diameter =
      find([](const std::string& t) { return IsOfDiameters(t) && UnitIn(t).has_value(); });
  if (columns.diameter == num_columns) columns.diameter = find(IsOfDiameters);
  if (columns.diameter == num_columns) columns.diameter = 0;
  const auto is_share = [&](const std::string& t) { return &t != &table.titles[columns.diameter]; };
  columns.share = find([&](const std::string& t) { return is_share(t) && IsOfFiner(t); });
  columns.cumulative = columns.share != num_columns;
  if (!columns.cumulative) {
    columns.share =
        find([&](const std::string& t) { return is_share(t) && !IsOfCoarser(t) && !IsDensity(t); });
  }
  if (columns.share == num_columns) {
    Refuse(path,
           "has only a cumulative share of what is coarser, or a density q(x); export what is "
           "finer, or the share of each class");
  }
  return columns;
}

// Without a word in the title: a column that never falls and ends at 1 or 100 is cumulative.
bool LooksCumulative(const std::vector<double>& shares) {
  return std::is_sorted(shares.begin(), shares.end()) &&
         (std::abs(shares.back() - 100) < 0.5 || std::abs(shares.back() - 1) < 0.005);
}

// Edges of the classes that `diameters` stand for.
std::vector<double> EdgesOf(const std::vector<double>& d, const std::string& title) {
  const std::size_t n = d.size();
  std::vector<double> edges;
  if (HasAny(title, {"lower", "low "})) {
    edges = d;
    edges.push_back(d[n - 1] * d[n - 1] / d[n - 2]);
  } else if (HasAny(title, {"upper", "xu", "xo"})) {
    edges = d;
    edges.insert(edges.begin(), d[0] * d[0] / d[1]);
  } else {  // the classes' middles, on the logarithmic scale of these instruments
    for (std::size_t i = 1; i < n; ++i) edges.push_back(std::sqrt(d[i - 1] * d[i]));
    edges.insert(edges.begin(), d[0] * d[0] / edges.front());
    edges.push_back(d[n - 1] * d[n - 1] / edges.back());
  }
  return edges;
}

// Drops the classes or points at both ends that hold nothing, so that they do not widen the curve.
void Trim(SizeDistribution& sizes) {
  auto& d = sizes.diameters;
  auto& s = sizes.shares;
  const bool classes = sizes.kind == SizeKind::kClasses;
  const auto empty = [&](std::size_t i) { return classes ? s[i] == 0 : s[i + 1] == s[i]; };
  std::size_t num_first = 0;
  while (s.size() - num_first > 2 && empty(num_first)) ++num_first;
  std::size_t num_last = 0;
  const std::size_t before_end = classes ? 1 : 2;
  while (s.size() - num_first - num_last > 2 && empty(s.size() - num_last - before_end)) ++num_last;
  for (auto* list : {&s, &d}) {  // each at once: one by one takes time that grows as the square
    list->resize(list->size() - num_last);
    list->erase(list->begin(), list->begin() + static_cast<std::ptrdiff_t>(num_first));
  }
}

}  // namespace

void ReadSizeFile(SizeDistribution& sizes) {
  if (sizes.kind != SizeKind::kFile || !sizes.file) return;
  ReadSizeText(base::ReadFile(*sizes.file, kLargestSizeFile), sizes);
}

void ReadSizeText(std::string text, SizeDistribution& sizes) {
  const std::filesystem::path path = sizes.file.value();
  const Table table = ReadTable(std::move(text), path);
  const Columns columns = Find(path, table);
  const std::string& title = table.titles[columns.diameter];
  const double unit = UnitOf(path, title, table.title_line);
  std::vector<std::pair<double, double>> points;
  for (const auto& [row, line] : table.rows) {
    if (row.size() <= columns.diameter || !(row[columns.diameter] > 0)) continue;
    const double share = row.size() > columns.share ? row[columns.share] : 0;
    if (!std::isfinite(share)) {
      Refuse(path, "line " + std::to_string(line) + ": its share is not a number");
    }
    points.emplace_back(row[columns.diameter] * unit, share);
  }
  std::sort(points.begin(), points.end());  // some instruments list the coarse end first
  if (points.size() < 2) Refuse(path, "has less than two diameters above zero");
  std::vector<double> diameters;
  sizes.shares.clear();
  for (const auto& [diameter, share] : points) {
    diameters.push_back(diameter);
    sizes.shares.push_back(share);
  }
  const bool cumulative = columns.cumulative || LooksCumulative(sizes.shares);
  sizes.kind = cumulative ? SizeKind::kCumulative : SizeKind::kClasses;
  sizes.diameters = cumulative ? diameters : EdgesOf(diameters, title);
  const std::string& share_title = table.titles[columns.share];
  if (HasAny(share_title, {"number", "q0", "Q0"})) sizes.by = Weighting::kNumber;
  if (HasAny(share_title, {"volume", "q3", "Q3"})) sizes.by = Weighting::kVolume;
  sizes.file.reset();
  Trim(sizes);
  base::Problems problems(path.string(), {});
  sizes.Validate(problems);
  problems.ThrowIfAny();
}

}  // namespace talus::engine
