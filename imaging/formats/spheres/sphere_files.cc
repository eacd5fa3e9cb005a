#include "imaging/formats/spheres/sphere_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>

#include "base/error.h"
#include "base/files/file.h"
#include "imaging/formats/spheres/sphere_formats.h"
#include "imaging/formats/spheres/text_cursor.h"

namespace talus::imaging {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHead = 4096;  // bytes that tell what a file is

// Together they are bounded as one file is: a part can be named many times.
void CheckSizeOfParts(const fs::path& path, const std::vector<fs::path>& parts) {
  std::uint64_t num_bytes = 0;
  for (const fs::path& part : parts) {
    std::error_code absent;  // is said when it is read
    const std::uintmax_t size = fs::file_size(path.parent_path() / part, absent);
    if (!absent) num_bytes += std::min<std::uint64_t>(size, base::kLargestRead);
    if (num_bytes <= base::kLargestRead) continue;
    throw base::ConfigError(path.string() + ": names parts of more than " +
                            std::to_string(base::kLargestRead >> 20) +
                            " MiB together, the most that is read");
  }
}

std::vector<base::Sphere> ReadParts(const fs::path& path, const std::vector<fs::path>& parts,
                                    const SphereFileOptions& options) {
  CheckSizeOfParts(path, parts);
  std::vector<base::Sphere> spheres;
  for (const fs::path& part : parts) {
    // A part is never a list of parts again; this also ends a file that names itself.
    if (!part.has_extension() || part.extension().string().starts_with(".p")) {
      throw base::ConfigError(path.string() + ": names the part \"" + part.string() +
                              "\", which is not a .vtp or .vtu file");
    }
    const auto more = ReadSpheres(path.parent_path() / part, options);
    spheres.insert(spheres.end(), more.begin(), more.end());
  }
  return spheres;
}

std::vector<base::Sphere> Parse(const fs::path& path, std::string_view text,
                                const SphereFileOptions& options) {
  const std::string file = path.string();
  const std::string_view start = Trimmed(text.substr(0, kHead));
  const double unit = options.length_unit.value_or(1);
  if (start.empty()) throw base::ConfigError(file + ": is empty");
  if (start.starts_with("ITEM:")) return ReadDump(text, file, options);
  if (start.starts_with("# vtk DataFile")) return SpheresOf(ReadVtkLegacy(text, file), file, unit);
  if (start.starts_with('<')) {
    const VtkXml xml = ReadVtkXml(text, file);
    if (!xml.parts.empty()) return ReadParts(path, xml.parts, options);
    return SpheresOf(xml.cloud, file, unit);
  }
  if (start.find('\0') != std::string_view::npos) {
    throw base::ConfigError(file +
                            ": is neither text nor VTK; CSV, text dumps of LIGGGHTS or LAMMPS, "
                            "VTK legacy, VTP and VTU are read");
  }
  return ReadSphereCsv(text, file, options);
}

}  // namespace

std::vector<base::Sphere> ReadSpheres(const fs::path& path, const SphereFileOptions& options) {
  const std::string text = base::ReadFile(path);
  std::vector<base::Sphere> spheres = Parse(path, text, options);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (IsFinite(spheres[i].position) && std::isfinite(spheres[i].radius) &&
        spheres[i].radius > 0) {
      continue;
    }
    throw base::ConfigError(path.string() + ": sphere " + std::to_string(i + 1) +
                            " has a position that is not finite or a radius that is not positive");
  }
  return spheres;
}

std::vector<fs::path> PartsOf(const fs::path& path) {
  std::string head(kHead, '\0');  // others may be large
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const bool names_parts = head.find("\"PPolyData\"") != std::string::npos ||
                           head.find("\"PUnstructuredGrid\"") != std::string::npos;
  if (!names_parts || !Trimmed(head).starts_with('<')) return {};
  std::vector<fs::path> parts;
  for (const fs::path& part : ReadVtkXml(base::ReadFile(path), path.string()).parts) {
    parts.push_back(path.parent_path() / part);
  }
  return parts;
}

}  // namespace talus::imaging
