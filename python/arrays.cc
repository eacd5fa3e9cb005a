#include "python/arrays.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/text/number_text.h"

namespace talus::python {

namespace py = pybind11;

namespace {

// Converted, a masked array would lose its mask without a word.
void RefuseMasked(const py::handle& array, const std::string& name) {
  if (py::module_::import("numpy").attr("ma").attr("is_masked")(array).cast<bool>()) {
    throw base::ConfigError(name + ": is a masked array; take out what is masked, or fill it");
  }
}

}  // namespace

imaging::GrayImage ImageOf(const py::handle& array, const std::string& name) {
  RefuseMasked(array, name);
  const py::array any = py::array::ensure(array);
  if (!any) throw base::ConfigError(name + ": must be an array of bytes");
  if (!py::isinstance<py::array_t<std::uint8_t>>(any)) {
    throw base::ConfigError(name + ": must be bytes (uint8), 0 powder to 255 none; it is of " +
                            py::str(any.dtype()).cast<std::string>());
  }
  if (any.ndim() != 2) {
    throw base::ConfigError(name + ": must have two dimensions, rows and columns");
  }
  if (any.size() == 0) throw base::ConfigError(name + ": is empty");
  constexpr py::ssize_t kMostPixels = 200'000'000;  // as of a file
  if (any.size() > kMostPixels) {
    throw base::ConfigError(name + ": has more than 200 million pixels");
  }
  const GrayArray rows = GrayArray::ensure(any);
  imaging::GrayImage image{.width = static_cast<int>(rows.shape(1)),
                           .height = static_cast<int>(rows.shape(0)),
                           .pixels = {}};
  image.pixels.assign(rows.data(), rows.data() + rows.size());
  return image;
}

GrayArray ArrayOf(const imaging::GrayImage& image) {
  GrayArray array({image.height, image.width});
  std::copy(image.pixels.begin(), image.pixels.end(), array.mutable_data());
  return array;
}

std::vector<base::Sphere> SpheresOf(const py::handle& array, double plate_diameter) {
  RefuseMasked(array, "spheres");
  const auto table = py::array_t<double, py::array::c_style>::ensure(array);
  if (!table || table.ndim() != 2 || table.shape(1) != 4) {
    throw base::ConfigError(
        "spheres: must be numbers in four columns: x, y, z and diameter in metres");
  }
  std::vector<base::Sphere> spheres;
  const auto rows = table.unchecked<2>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    const double x = rows(i, 0), y = rows(i, 1), z = rows(i, 2), diameter = rows(i, 3);
    const std::string row = "spheres: row " + std::to_string(i);
    if (!std::isfinite(x + y + z) || !(diameter > 0 && std::isfinite(diameter))) {
      throw base::ConfigError(row +
                              " has a position that is no number, or a diameter that is not "
                              "positive");
    }
    if (diameter > plate_diameter) {
      throw base::ConfigError(row + " has a diameter of " + base::ShortNumber(diameter) +
                              " m, wider than the plate; give metres");
    }
    spheres.push_back({.position = {x, y, z}, .radius = 0.5 * diameter});
  }
  return spheres;
}

double NumberOf(const py::handle& value, const std::string& name) {
  try {
    if (!py::isinstance<py::bool_>(value)) return value.cast<double>();
  } catch (const py::cast_error&) {
    if (py::isinstance<py::int_>(value)) {
      throw base::ConfigError(name + ": is beyond 1.8e308, the largest number there is");
    }
  }
  throw base::ConfigError(name + ": must be a number; it is a " +
                          py::str(py::type::of(value).attr("__name__")).cast<std::string>());
}

std::string JsonOf(const py::handle& value) {
  return py::module_::import("json").attr("dumps")(value).cast<std::string>();
}

imaging::Frame FrameOf(const py::dict& frame) {
  return base::LoadOptions<imaging::Frame>(base::ParseJson(JsonOf(frame), "frame"));
}

}  // namespace talus::python
