// The numbers of one <DataArray> of a VTK XML file, however they are stored.
#pragma once

#include <bit>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/formats/spheres/vtk_types.h"

namespace talus::imaging {

// What the file's root and its appended block say; it holds for all arrays.
struct VtkEncoding {
  std::endian order = std::endian::little;
  VtkType header = VtkType::kUInt32;  // of the byte counts before the data
  bool zlib = false;                  // compressed block by block
  bool appended_base64 = false;
  std::string_view appended;  // after the `_`
};

struct VtkArray {
  std::string name;
  std::string format;  // "ascii", "binary" or "appended"
  VtkType type = VtkType::kFloat;
  std::string_view text;   // what stands in the element
  std::size_t offset = 0;  // [bytes] into the appended block
  std::size_t count = 0;   // of the values that the piece says there are, below 2^40
};

// Throws base::Error with what is wrong (cut off, not base64, damaged); the caller adds the file.
std::vector<double> ReadValues(const VtkArray& array, const VtkEncoding& encoding);

}  // namespace talus::imaging
