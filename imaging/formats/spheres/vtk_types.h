// The number types of VTK's files, by their names in either format, and their bytes as doubles.
#pragma once

#include <bit>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace talus::imaging {

enum class VtkType {
  kInt8,
  kUInt8,
  kInt16,
  kUInt16,
  kInt32,
  kUInt32,
  kInt64,
  kUInt64,
  kFloat,
  kDouble
};

// "Float32" (XML) or "float" (legacy); nothing for a type that is not a number of whole bytes.
std::optional<VtkType> VtkTypeOf(std::string_view name);

std::size_t SizeOf(VtkType type);  // [bytes]

// As many values as whole ones fit into `bytes`.
std::vector<double> Decode(VtkType type, std::string_view bytes, std::endian order);

}  // namespace talus::imaging
