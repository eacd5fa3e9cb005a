// Size distributions as laser-diffraction instruments export them: which column of the table is a
// diameter and which a share, cumulative or of each class.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
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

// What one sieve has retained is a class; cumulated from the coarsest down it is what is coarser.
bool IsRetained(const std::string& title) { return HasAny(title, {"retained", "r\u00fcckstand"}); }
bool IsOfCoarser(const std::string& title) {
  return HasAny(title, {"over", ">", "coarser"}) ||
         (IsRetained(title) && HasAny(title, {"cum", "sum"}));
}
bool IsOfFiner(const std::string& title) {
  return !IsOfCoarser(title) &&
         (HasAny(title,
                 {"under", "cum", "passing", "percentile", "finer", "<", "sum", "durchgang"}) ||
          HasWord(title, "tile") || BeginsWithAny(title, {"Q3", "Q0", "below", "less"}));
}
// Such a column is no curve, however its numbers rise.
bool IsOfClasses(const std::string& title) {
  return IsRetained(title) || HasWord(title, "diff") ||
         BeginsWithAny(title, {"differential", "freq", "density", "class", "channel"});
}
// What lies on a sieve is coarser than its mesh.
bool IsOfSieves(const std::string& title) {
  return HasAny(title, {"sieve", "mesh", "opening", "aperture", "maschenweite"});
}
// Per length, or per decade: no share of a class.
bool IsDensity(const std::string& title) {
  return BeginsWithAny(title, {"q3", "q0"}) && title.find('%') == std::string::npos;
}
bool IsOfDiameters(const std::string& title) {
  const bool is_share = IsOfCoarser(title) || IsRetained(title) ||
                        HasAny(title, {"%", "under", "passing", "finer", "durchgang"}) ||
                        BeginsWithAny(title, {"percent", "share", "cum", "Q3", "Q0", "q3", "q0"});
  return !is_share &&
         (IsOfSieves(title) || HasAny(title, {"diameter", "particle", "channel"}) ||
          HasWord(title, "size") ||
          BeginsWithAny(title, {"x0", "xu", "d ", "x ", "d[", "x[", "d(", "x(", "d/", "x/"}));
}

[[noreturn]] void RefuseCoarser(const std::filesystem::path& path) {
  RefuseSizeFile(path,
                 "has only a cumulative share of what is coarser, or a density q(x); export what "
                 "is finer, or the share of each class");
}

// Words of the head stand above the titles, in their columns: where the last line of titles says
// what the columns are, they do not count.
const std::string& OwnTitle(const SizeTable& table, std::size_t column) {
  const bool is_complete = std::ranges::any_of(table.last_titles, IsOfDiameters);
  return (is_complete ? table.last_titles : table.titles)[column];
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
  const auto is_of_classes = [&](const std::string& t) {
    return is_share(t) && !IsOfCoarser(t) && !IsDensity(t);
  };
  if (!columns.cumulative) {  // a table of sieves may have their numbers and weights, too
    columns.share = find([&](const std::string& t) { return is_of_classes(t) && IsRetained(t); });
    if (columns.share == num_columns) {
      columns.share =
          find([&](const std::string& t) { return is_of_classes(t) && !IsOfDiameters(t); });
    }
    if (columns.share == num_columns) columns.share = find(is_of_classes);
  }
  if (columns.share == num_columns) RefuseCoarser(path);
  return columns;
}

double SumOf(const std::vector<double>& shares) {
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

// All there is, in percent or as a share.
bool IsAll(double sum) { return std::abs(sum - 100) < 0.5 || std::abs(sum - 1) < 0.005; }

// Without a word in the title: a column that never falls and ends at 1 or 100 is cumulative, unless
// its numbers add up to that: then one class holds all.
bool LooksCumulative(const std::vector<double>& shares, const std::string& title) {
  return !IsOfClasses(title) && std::is_sorted(shares.begin(), shares.end()) &&
         IsAll(shares.back()) && SumOf(shares) > 1.005 * shares.back();
}

// A sum of more than all there is: each share holds those of the coarser sieves.
bool LooksCumulatedOverSieves(const std::vector<double>& shares, const std::string& title) {
  constexpr double kMost = 105;  // [%], rounded and weighed as shares are
  return IsRetained(title) && HasAny(title, {"%", "percent"}) && SumOf(shares) > kMost;
}

// Edges of the classes that `diameters` stand for.
std::vector<double> EdgesOf(const std::vector<double>& d, const std::string& title) {
  const std::size_t n = d.size();
  std::vector<double> edges = d;
  const bool is_upper = HasAny(title, {"upper", "xu", "xo"});
  if (HasAny(title, {"lower", "low "}) || (IsOfSieves(title) && !is_upper)) {
    edges.push_back(d[n - 1] * d[n - 1] / d[n - 2]);
  } else if (is_upper) {
    edges.insert(edges.begin(), d[0] * d[0] / d[1]);
  } else {  // the classes' middles, on the logarithmic scale of these instruments
    edges.clear();
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
  const std::size_t fewest = classes ? 1 : 2;
  std::size_t num_first = 0;
  while (s.size() - num_first > fewest && empty(num_first)) ++num_first;
  std::size_t num_last = 0;
  const std::size_t before_end = classes ? 1 : 2;
  while (s.size() - num_first - num_last > fewest && empty(s.size() - num_last - before_end)) {
    ++num_last;
  }
  for (auto* list : {&s, &d}) {  // each at once: one by one takes time that grows as the square
    list->resize(list->size() - num_last);
    list->erase(list->begin(), list->begin() + static_cast<std::ptrdiff_t>(num_first));
  }
}

// Diameters [m] and their shares, the fine end first, and what has passed every sieve.
struct Points {
  std::vector<double> diameters;
  std::vector<double> shares;
  double in_pan = 0;
};

Points PointsOf(const std::filesystem::path& path, const SizeTable& table, const Columns& columns,
                double unit) {
  const bool has_pan = IsOfSieves(OwnTitle(table, columns.diameter));
  std::vector<std::pair<double, double>> sorted;  // some instruments list the coarse end first
  Points points;
  for (const auto& [row, line] : table.rows) {
    const double diameter = row.size() > columns.diameter ? row[columns.diameter] : -1;
    const bool is_pan = has_pan && row.size() > columns.diameter && diameter <= 0;
    if (!(diameter > 0) && !is_pan) continue;
    const double share = row.size() > columns.share ? row[columns.share] : 0;
    if (!std::isfinite(share)) {
      RefuseSizeFile(path, "line " + std::to_string(line) + ": its share is not a number");
    }
    if (is_pan) {
      points.in_pan += share;
    } else {
      sorted.emplace_back(diameter * unit, share);
    }
  }
  std::sort(sorted.begin(), sorted.end());
  if (sorted.size() < 2) RefuseSizeFile(path, "has less than two diameters above zero");
  for (const auto& [diameter, share] : sorted) {
    points.diameters.push_back(diameter);
    points.shares.push_back(share);
  }
  return points;
}

// Nobody knows how fine the pan's grains are: their class is taken to be as wide as the next one,
// on a logarithmic scale.
void SetClasses(Points points, const std::string& title, SizeDistribution& sizes) {
  sizes.kind = SizeKind::kClasses;
  sizes.diameters = EdgesOf(points.diameters, title);
  sizes.shares = std::move(points.shares);
  if (points.in_pan == 0) return;
  const auto& d = points.diameters;
  const double finest = d[0] * d[0] / d[1];
  if (sizes.diameters.front() <= finest) {  // of upper edges: the finest class is below them all
    sizes.shares.front() += points.in_pan;
    return;
  }
  sizes.diameters.insert(sizes.diameters.begin(), finest);
  sizes.shares.insert(sizes.shares.begin(), points.in_pan);
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
  const std::string& share_title = table.titles[columns.share];
  Points points = PointsOf(path, table, columns, UnitOf(path, title, table.title_line));
  if (columns.cumulative || LooksCumulative(points.shares, OwnTitle(table, columns.share))) {
    sizes.kind = SizeKind::kCumulative;
    sizes.diameters = std::move(points.diameters);
    sizes.shares = std::move(points.shares);
  } else {
    if (LooksCumulatedOverSieves(points.shares, share_title)) RefuseCoarser(path);
    SetClasses(std::move(points), OwnTitle(table, columns.diameter), sizes);
  }
  if (HasAny(share_title, {"number", "q0", "Q0"})) sizes.by = Weighting::kNumber;
  if (HasAny(share_title, {"volume", "q3", "Q3"})) sizes.by = Weighting::kVolume;
  sizes.file.reset();
  Trim(sizes);
  base::Problems problems(path.string(), {});
  sizes.Validate(problems);
  problems.ThrowIfAny();
}

}  // namespace talus::engine
