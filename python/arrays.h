// Between numpy's arrays and our own images and spheres.
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "base/sphere.h"
#include "imaging/heap/profile.h"

namespace talus::python {

// Row by row from the top, 0 black … 255 white.
using GrayArray = pybind11::array_t<std::uint8_t, pybind11::array::c_style>;
// x, y, z and diameter [m], one sphere a row.
using SphereArray = pybind11::array_t<double, pybind11::array::c_style>;

imaging::GrayImage ImageOf(const GrayArray& array);
GrayArray ArrayOf(const imaging::GrayImage& image);
std::vector<base::Sphere> SpheresOf(const SphereArray& array);

// A dictionary with the keys of a profile's frame, as spec files and result.json have them.
imaging::Frame FrameOf(const pybind11::dict& frame);

// Anything that json.dumps takes, read as one of our option structs.
std::string JsonOf(const pybind11::handle& value);
pybind11::object FromJson(const std::string& text);

}  // namespace talus::python
