// Spheres of a scene from a CSV file, such as the states that a scene leaves.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "base/vec3.h"

namespace talus::engine {

struct SphereSpec;
struct NamedMaterial;

// Columns x_m, y_m, z_m, and diameter_m or radius_m; if wanted vx_m_per_s …, wx_rad_per_s …, and
// type, the number of a material from 0 on, which counts where `material` is not given. Other
// columns are left alone.
struct SphereFileSpec {
  std::filesystem::path file;
  std::string material;  // name; empty: the column `type`, else the first

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("file", self.file,
          {.required = true, .doc = "CSV: x_m, y_m, z_m, diameter_m or radius_m, and velocities"});
    visit("material", self.material,
          {.doc = "name of a material; default: the column type, else the first"});
  }
};

// In the file's order. Throws ConfigError that names the file, the line and the remedy.
std::vector<SphereSpec> ReadSphereFile(const SphereFileSpec& spec,
                                       const std::vector<NamedMaterial>& materials);

// The same with the file's content at hand; `spec.file` is its name.
std::vector<SphereSpec> ReadSphereText(std::string_view text, const SphereFileSpec& spec,
                                       const std::vector<NamedMaterial>& materials);

}  // namespace talus::engine
