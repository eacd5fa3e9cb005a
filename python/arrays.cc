#include "python/arrays.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/json/json_reader.h"

namespace talus::python {

imaging::GrayImage ImageOf(const GrayArray& array) {
  if (array.ndim() != 2)
    throw base::ConfigError("image: must have two dimensions, rows and columns");
  if (array.size() == 0) throw base::ConfigError("image: is empty");
  imaging::GrayImage image{.width = static_cast<int>(array.shape(1)),
                           .height = static_cast<int>(array.shape(0)),
                           .pixels = {}};
  image.pixels.assign(array.data(), array.data() + array.size());
  return image;
}

GrayArray ArrayOf(const imaging::GrayImage& image) {
  GrayArray array({image.height, image.width});
  std::copy(image.pixels.begin(), image.pixels.end(), array.mutable_data());
  return array;
}

std::vector<base::Sphere> SpheresOf(const SphereArray& array) {
  if (array.ndim() != 2 || array.shape(1) != 4) {
    throw base::ConfigError("spheres: must have four columns: x, y, z and diameter in metres");
  }
  std::vector<base::Sphere> spheres;
  const auto rows = array.unchecked<2>();
  for (pybind11::ssize_t i = 0; i < rows.shape(0); ++i) {
    const double x = rows(i, 0), y = rows(i, 1), z = rows(i, 2), diameter = rows(i, 3);
    if (!std::isfinite(x + y + z) || !(diameter > 0 && std::isfinite(diameter))) {
      throw base::ConfigError("spheres: row " + std::to_string(i) +
                              " has a position that is no number, or a diameter that is not "
                              "positive");
    }
    spheres.push_back({.position = {x, y, z}, .radius = 0.5 * diameter});
  }
  return spheres;
}

std::string JsonOf(const pybind11::handle& value) {
  return pybind11::module_::import("json").attr("dumps")(value).cast<std::string>();
}

pybind11::object FromJson(const std::string& text) {
  return pybind11::module_::import("json").attr("loads")(text);
}

imaging::Frame FrameOf(const pybind11::dict& frame) {
  return base::LoadOptions<imaging::Frame>(base::ParseJson(JsonOf(frame), "frame"));
}

}  // namespace talus::python
