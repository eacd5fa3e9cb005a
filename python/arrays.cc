#include "python/arrays.h"

#include <algorithm>

#include "base/error.h"
#include "base/json/json_reader.h"

namespace talus::python {

imaging::GrayImage ImageOf(const GrayArray& array) {
  if (array.ndim() != 2)
    throw base::ConfigError("image: must have two dimensions, rows and columns");
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
    spheres.push_back(
        {.position = {rows(i, 0), rows(i, 1), rows(i, 2)}, .radius = 0.5 * rows(i, 3)});
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
