#include "imaging/formats/spheres/vtk_types.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace talus::imaging {
namespace {

using enum VtkType;

// Calls `use` with a value of the C++ type behind `type`.
template <class Use>
auto Dispatch(VtkType type, Use&& use) {
  switch (type) {
    case kInt8:
      return use(std::int8_t{});
    case kUInt8:
      return use(std::uint8_t{});
    case kInt16:
      return use(std::int16_t{});
    case kUInt16:
      return use(std::uint16_t{});
    case kInt32:
      return use(std::int32_t{});
    case kUInt32:
      return use(std::uint32_t{});
    case kInt64:
      return use(std::int64_t{});
    case kUInt64:
      return use(std::uint64_t{});
    case kFloat:
      return use(float{});
    case kDouble:
      break;
  }
  return use(double{});
}

}  // namespace

std::optional<VtkType> VtkTypeOf(std::string_view name) {
  // A legacy file's long is the writing machine's: 8 bytes on all that still write such files.
  constexpr std::pair<std::string_view, VtkType> kNames[] = {{"Float32", kFloat},
                                                             {"Float64", kDouble},
                                                             {"Int8", kInt8},
                                                             {"UInt8", kUInt8},
                                                             {"Int16", kInt16},
                                                             {"UInt16", kUInt16},
                                                             {"Int32", kInt32},
                                                             {"UInt32", kUInt32},
                                                             {"Int64", kInt64},
                                                             {"UInt64", kUInt64},
                                                             {"float", kFloat},
                                                             {"double", kDouble},
                                                             {"char", kInt8},
                                                             {"signed_char", kInt8},
                                                             {"unsigned_char", kUInt8},
                                                             {"short", kInt16},
                                                             {"unsigned_short", kUInt16},
                                                             {"int", kInt32},
                                                             {"unsigned_int", kUInt32},
                                                             {"long", kInt64},
                                                             {"unsigned_long", kUInt64},
                                                             {"vtktypeint64", kInt64},
                                                             {"vtktypeuint64", kUInt64},
                                                             {"vtkIdType", kInt32}};
  for (const auto& [known, type] : kNames) {
    if (known == name) return type;
  }
  return std::nullopt;
}

std::size_t SizeOf(VtkType type) {
  return Dispatch(type, [](auto value) { return sizeof value; });
}

std::vector<double> Decode(VtkType type, std::string_view bytes, std::endian order) {
  return Dispatch(type, [&](auto value) {
    std::vector<double> values(bytes.size() / sizeof value);
    for (std::size_t i = 0; i < values.size(); ++i) {
      char raw[sizeof value];
      std::memcpy(raw, bytes.data() + i * sizeof value, sizeof value);
      if (order != std::endian::native) std::reverse(raw, raw + sizeof value);
      std::memcpy(&value, raw, sizeof value);
      values[i] = static_cast<double>(value);
    }
    return values;
  });
}

}  // namespace talus::imaging
