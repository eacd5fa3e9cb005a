// What a column or array of a sphere file means, by its name; the same for every format.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/sphere.h"
#include "imaging/formats/spheres/sphere_files.h"

namespace talus::imaging {

// One of the four things a sphere is made of.
enum class SpherePart { kX, kY, kZ, kRadius };

struct ColumnMeaning {
  SpherePart part = SpherePart::kX;
  double factor = 1;           // 1/2 for a diameter [-]
  std::optional<double> unit;  // one unit of the column [m], where its name says so: `x_mm`
};

// "x_m", "Points:0", "Diameter", "radii", "r [mm]"; nothing for a name that means something else.
std::optional<ColumnMeaning> MeaningOf(std::string_view name);

// Which columns of a table make the spheres. A radius is preferred where both are given.
class SphereColumns {
 public:
  // Fails, naming `file` and the columns there are, when one of the four parts is not among them.
  SphereColumns(std::span<const std::string> names, const std::string& file, double length_unit);

  // The sphere of one row of the table, which has a value for each name.
  base::Sphere Row(std::span<const double> values) const;

 private:
  struct Source {
    std::size_t column = 0;
    double scale = 0;  // file units → m
  };
  Source sources_[4];
};

// Points and their data arrays, as VTK's formats have them.
struct PointCloud {
  struct Array {
    std::string name;
    std::vector<double> values;  // one a point
  };
  std::vector<double> points;  // x, y, z of each point in turn
  std::vector<Array> arrays;   // those with one component
};
std::vector<base::Sphere> SpheresOf(const PointCloud& cloud, const std::string& file,
                                    double length_unit);

}  // namespace talus::imaging
