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

// Two dimensions of bytes; anything else throws ConfigError, which calls it `name`. Numbers of
// another type are not converted: shares from 0 to 1 and masks would be read as black. A masked
// array is refused.
imaging::GrayImage ImageOf(const pybind11::handle& array, const std::string& name);
GrayArray ArrayOf(const imaging::GrayImage& image);

// x, y, z and diameter [m], one sphere a row. Throws ConfigError where a number is none, or a
// sphere is wider than the plate, as in a table in millimetres, or some are masked.
std::vector<base::Sphere> SpheresOf(const pybind11::handle& array, double plate_diameter);

// NaN and infinity are numbers, True and False are none. Throws ConfigError that starts with `name`
// where it is none.
double NumberOf(const pybind11::handle& value, const std::string& name);

// A dictionary with the keys of a profile's frame, as spec files and result.json have them.
imaging::Frame FrameOf(const pybind11::dict& frame);

// Anything that json.dumps takes, read as one of our option structs.
std::string JsonOf(const pybind11::handle& value);

}  // namespace talus::python
