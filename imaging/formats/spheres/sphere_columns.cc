#include "imaging/formats/spheres/sphere_columns.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/text/lower.h"
#include "imaging/formats/spheres/text_cursor.h"

namespace talus::imaging {
namespace {

using enum SpherePart;

constexpr std::pair<std::string_view, double> kUnits[] = {
    {"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}};

struct Known {
  std::string_view name;
  SpherePart part;
  double factor;
};
// "points:0" is how ParaView names the columns of an exported table, "radii" is YADE's.
constexpr Known kKnown[] = {{"x", kX, 1},           {"y", kY, 1},
                            {"z", kZ, 1},           {"xu", kX, 1},
                            {"yu", kY, 1},          {"zu", kZ, 1},
                            {"points:0", kX, 1},    {"points:1", kY, 1},
                            {"points:2", kZ, 1},    {"r", kRadius, 1},
                            {"radius", kRadius, 1}, {"radii", kRadius, 1},
                            {"d", kRadius, 0.5},    {"diameter", kRadius, 0.5}};

// Cuts "_mm", " [mm]" or " (mm)" off the end of `name`.
std::optional<double> CutUnit(std::string& name) {
  std::string_view rest = name;
  const bool bracketed = rest.ends_with(']') || rest.ends_with(')');
  if (bracketed) rest.remove_suffix(1);
  for (const auto& [unit, meters] : kUnits) {
    if (!rest.ends_with(unit)) continue;
    const std::string_view before = rest.substr(0, rest.size() - unit.size());
    const char mark = before.empty() ? ' ' : before.back();
    if (bracketed ? (mark == '[' || mark == '(') : mark == '_') {
      name = std::string(Trimmed(before.substr(0, before.size() - 1)));
      return meters;
    }
  }
  return std::nullopt;
}

std::string Joined(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

// Nobody can tell which of two columns of one name is meant.
void RequireOneOfEach(std::span<const std::string> names, const std::string& file) {
  for (std::size_t c = 0; c < names.size(); ++c) {
    const bool twice = std::ranges::count(names, names[c]) > 1;
    if (!twice || !MeaningOf(names[c])) continue;
    throw base::ConfigError(file + ": has two columns called " + names[c] + " (" + Joined(names) +
                            "); leave one out, or name them apart");
  }
}

}  // namespace

std::optional<ColumnMeaning> MeaningOf(std::string_view name) {
  std::string lower = base::Lower(std::string(Trimmed(name)));
  const std::optional<double> unit = CutUnit(lower);
  for (const Known& known : kKnown) {
    if (known.name == lower) return ColumnMeaning{known.part, known.factor, unit};
  }
  return std::nullopt;
}

SphereColumns::SphereColumns(std::span<const std::string> names, const std::string& file,
                             double length_unit) {
  RequireOneOfEach(names, file);
  bool is_radius = false;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::optional<ColumnMeaning> meaning = MeaningOf(names[c]);
    if (!meaning) continue;
    Source& source = sources_[static_cast<std::size_t>(meaning->part)];
    const bool prefer = meaning->part == kRadius && meaning->factor == 1 && !is_radius;
    if (source.scale != 0 && !prefer) continue;
    is_radius = is_radius || prefer;
    source = {.column = c, .scale = meaning->factor * meaning->unit.value_or(length_unit)};
  }
  for (const auto& [part, what] : {std::pair{kX, "x"}, std::pair{kY, "y"}, std::pair{kZ, "z"},
                                   std::pair{kRadius, "radius or diameter"}}) {
    if (sources_[static_cast<std::size_t>(part)].scale == 0) {
      throw base::ConfigError(file + ": has no " + what + " among its columns (" + Joined(names) +
                              "); write one out");
    }
  }
}

base::Sphere SphereColumns::Row(std::span<const double> values) const {
  const auto value = [&](SpherePart part) {
    const Source& source = sources_[static_cast<std::size_t>(part)];
    return source.scale * values[source.column];
  };
  return {.position = {value(kX), value(kY), value(kZ)}, .radius = value(kRadius)};
}

std::vector<base::Sphere> SpheresOf(const PointCloud& cloud, const std::string& file,
                                    double length_unit) {
  if (cloud.points.empty()) return {};  // an empty heap may come without arrays
  std::vector<std::string> names{"x", "y", "z"};
  for (const PointCloud::Array& array : cloud.arrays) {
    // A data array called `x` is not the points' own coordinate.
    const std::optional<ColumnMeaning> meaning = MeaningOf(array.name);
    names.push_back(meaning && meaning->part != kRadius ? "data " + array.name : array.name);
  }
  const SphereColumns columns(names, file, length_unit);
  std::vector<base::Sphere> spheres(cloud.points.size() / 3);
  std::vector<double> row(names.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    std::copy_n(cloud.points.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, row.begin());
    for (std::size_t a = 0; a < cloud.arrays.size(); ++a) row[3 + a] = cloud.arrays[a].values[i];
    spheres[i] = columns.Row(row);
  }
  return spheres;
}

}  // namespace talus::imaging
