// Size distributions as laser-diffraction instruments export them: which column of the table is a
// diameter and which a share, cumulative or of each class.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/units.h"
#include "engine/scene/size_distribution.h"
#include "engine/scene/size_table.h"

namespace talus::engine {
namespace {

constexpr std::uint64_t kLargestSizeFile = 16u << 20;  // [bytes]; instruments write some kB

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
  RefuseSizeFile(path,
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

Columns Find(const std::filesystem::path& path, const SizeTable& table) {
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
    RefuseSizeFile(
        path,
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
  const SizeTable table = ReadSizeTable(text, path);
  const Columns columns = Find(path, table);
  const std::string& title = table.titles[columns.diameter];
  const double unit = UnitOf(path, title, table.title_line);
  std::vector<std::pair<double, double>> points;
  for (const auto& [row, line] : table.rows) {
    if (row.size() <= columns.diameter || !(row[columns.diameter] > 0)) continue;
    const double share = row.size() > columns.share ? row[columns.share] : 0;
    if (!std::isfinite(share)) {
      RefuseSizeFile(path, "line " + std::to_string(line) + ": its share is not a number");
    }
    points.emplace_back(row[columns.diameter] * unit, share);
  }
  std::sort(points.begin(), points.end());  // some instruments list the coarse end first
  if (points.size() < 2) RefuseSizeFile(path, "has less than two diameters above zero");
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
