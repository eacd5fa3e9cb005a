// Spheres from the files that DEM codes write: what they are is found from their first bytes, what
// a column or array means from its name.
//
//   CSV           talus, ParaView, YADE's text export: x, y, z and a radius or diameter
//   dump          LIGGGHTS and LAMMPS text dumps, coordinates plain, unwrapped or scaled
//   VTK legacy    ASCII or binary: LIGGGHTS and its post-processors
//   VTP, VTU      ASCII, base64 or raw appended, zlib compressed or not: talus, Lethe, YADE
//   PVTP, PVTU    the parts they name, put together: Lethe
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/sphere.h"

namespace talus::imaging {

struct SphereFileOptions {
  // One length unit of the file [m]. Unset: what the file itself says (a column `x_mm`, LAMMPS'
  // `ITEM: UNITS`), else metres. A unit in a column's name holds even where this is set.
  std::optional<double> length_unit = std::nullopt;
  std::optional<std::int64_t> timestep = std::nullopt;  // the frame of a dump; unset: the last
};

// The spheres in the file's order, in SI; possibly none. Throws ConfigError that names the file,
// the place and what is wrong: unknown, cut off, without a radius, a value that is not finite.
std::vector<base::Sphere> ReadSpheres(const std::filesystem::path& path,
                                      const SphereFileOptions& options = {});

// The files that a PVTP or PVTU file names, by their paths; of any other file none. Throws
// ConfigError where it cannot be read.
std::vector<std::filesystem::path> PartsOf(const std::filesystem::path& path);

}  // namespace talus::imaging
