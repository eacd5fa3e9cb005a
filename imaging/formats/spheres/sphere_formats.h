// The readers behind ReadSpheres, one a format. Each takes the whole file and names `file` in
// errors.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/sphere.h"
#include "imaging/formats/spheres/sphere_columns.h"
#include "imaging/formats/spheres/sphere_files.h"

namespace talus::imaging {

std::vector<base::Sphere> ReadSphereCsv(std::string_view text, const std::string& file,
                                        const SphereFileOptions& options);

std::vector<base::Sphere> ReadDump(std::string_view text, const std::string& file,
                                   const SphereFileOptions& options);

// Legacy `# vtk DataFile`: points with their scalars, whichever the data set's kind.
PointCloud ReadVtkLegacy(std::string_view text, const std::string& file);

// A VTP or VTU file holds its points, a PVTP or PVTU file the names of the files that do.
struct VtkXml {
  PointCloud cloud;
  std::vector<std::filesystem::path> parts;  // relative to the file
};
VtkXml ReadVtkXml(std::string_view text, const std::string& file);

}  // namespace talus::imaging
