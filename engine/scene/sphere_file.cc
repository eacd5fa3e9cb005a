#include "engine/scene/sphere_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/text/byte_order_mark.h"
#include "base/text/printable.h"
#include "base/trimmed.h"
#include "engine/scene/scene_spec.h"

namespace talus::engine {
namespace {

constexpr std::uint64_t kLargestSphereFile = std::uint64_t{1} << 30;  // [bytes], some million

std::vector<std::string_view> Parts(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

std::string_view Unquoted(std::string_view text) { return base::Trimmed(text, " \t\r\""); }

class SphereTable {
 public:
  SphereTable(const SphereFileSpec& spec, const std::vector<NamedMaterial>& materials)
      : spec_(spec), materials_(materials) {}

  std::vector<SphereSpec> Read(std::string_view text) {
    const std::vector<std::string_view> lines = Parts(base::WithoutByteOrderMark(text), '\n');
    ReadTitles(lines.front());
    std::vector<SphereSpec> spheres;
    for (line_ = 1; line_ < lines.size(); ++line_) {
      if (Unquoted(lines[line_]).empty()) continue;
      spheres.push_back(Sphere(lines[line_]));
    }
    if (spheres.empty()) Refuse("has no spheres");
    return spheres;
  }

 private:
  [[noreturn]] void Refuse(const std::string& why) const {
    throw base::ConfigError(spec_.file.string() + ": " + why);
  }

  [[noreturn]] void RefuseLine(const std::string& why) const {
    Refuse("line " + std::to_string(line_ + 1) + ": " + why);
  }

  void ReadTitles(std::string_view line) {
    for (const std::string_view title : Parts(line, ',')) titles_.emplace_back(Unquoted(title));
    for (const std::string& title : titles_) {
      if (!title.empty() && std::count(titles_.begin(), titles_.end(), title) > 1) {
        Refuse("has the column " + base::Printable(title) + " twice");
      }
    }
    for (const char* needed : {"x_m", "y_m", "z_m"}) {
      if (!Find(needed)) Refuse("has no column " + std::string(needed) + kRemedy);
    }
    if (!Find("diameter_m") && !Find("radius_m")) {
      Refuse("has no column diameter_m or radius_m" + std::string(kRemedy));
    }
  }

  std::optional<std::size_t> Find(std::string_view title) const {
    const auto found = std::find(titles_.begin(), titles_.end(), title);
    if (found == titles_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - titles_.begin());
  }

  SphereSpec Sphere(std::string_view line) {
    cells_ = Parts(line, ',');
    if (cells_.size() != titles_.size()) {
      RefuseLine("has " + std::to_string(cells_.size()) + " columns, the first line " +
                 std::to_string(titles_.size()));
    }
    const bool by_radius = !Find("diameter_m");
    const SphereSpec sphere{
        .material = spec_.material.empty() ? MaterialName() : spec_.material,
        .diameter = by_radius ? 2 * Number("radius_m") : Number("diameter_m"),
        .position = {Number("x_m"), Number("y_m"), Number("z_m")},
        .velocity = {Number("vx_m_per_s"), Number("vy_m_per_s"), Number("vz_m_per_s")},
        .angular_velocity = {Number("wx_rad_per_s"), Number("wy_rad_per_s"),
                             Number("wz_rad_per_s")}};
    if (!by_radius && Find("radius_m") &&
        std::abs(2 * Number("radius_m") - sphere.diameter) > 1e-3 * sphere.diameter) {
      RefuseLine("diameter_m is not twice radius_m; leave one of them out");
    }
    if (!(sphere.diameter > 0)) RefuseLine("a sphere's diameter must be positive");
    return sphere;
  }

  std::string MaterialName() const {
    const double type = Number("type");
    if (!(type >= 0 && type < static_cast<double>(materials_.size()) && type == std::floor(type))) {
      RefuseLine("type is not the number of a material, from 0 on");
    }
    return materials_[static_cast<std::size_t>(type)].name;
  }

  // 0 where there is no such column.
  double Number(std::string_view title) const {
    const std::optional<std::size_t> column = Find(title);
    if (!column) return 0;
    const std::string_view cell = Unquoted(cells_[*column]);
    double value = 0;
    const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (cell.empty() || read.ec != std::errc() || read.ptr != cell.data() + cell.size() ||
        !std::isfinite(value)) {
      RefuseLine(std::string(title) + " is \"" + base::Printable(std::string(cell)) +
                 "\", not a number");
    }
    return value;
  }

  static constexpr const char* kRemedy = "; the first line names the columns, in SI units";

  const SphereFileSpec& spec_;
  const std::vector<NamedMaterial>& materials_;
  std::vector<std::string> titles_{};
  std::vector<std::string_view> cells_{};
  std::size_t line_ = 0;  // from 0
};

}  // namespace

std::vector<SphereSpec> ReadSphereFile(const SphereFileSpec& spec,
                                       const std::vector<NamedMaterial>& materials) {
  return ReadSphereText(base::ReadFile(spec.file, kLargestSphereFile), spec, materials);
}

std::vector<SphereSpec> ReadSphereText(std::string_view text, const SphereFileSpec& spec,
                                       const std::vector<NamedMaterial>& materials) {
  return SphereTable(spec, materials).Read(text);
}

}  // namespace talus::engine
