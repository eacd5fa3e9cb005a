// What a `Visit` list says of each of its fields: one list serves the JSON reader, the writer, the
// JSON Schema and the hash that a resumed campaign is checked with.
//
//   template <class Self, class Visitor>
//   static void Visit(Self& self, Visitor&& visit) {
//     visit("density", self.density, {.dimension = Dimension::kDensity, .required = true,
//                                     .doc = "solid density of a grain, > 0"});
//   }
//
// A field is a bool, an integer, a double, a string, a path, an enum that has Names, another struct
// with Visit, a std::optional or a std::vector of one of these, or a base::Vec3.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "base/units.h"

namespace talus::base {

struct FieldInfo {
  Dimension dimension = Dimension::kNone;
  bool required = false;  // a file without the key is an error
  const char* doc = "";   // what it is, its unit and range: shown by editors from the JSON Schema
};

// The names of an enum as they stand in JSON. Specialise beside the enum:
//   template <> struct base::Names<Rolling> {
//     static constexpr std::array kList{std::pair{"none", Rolling::kNone}, …};
//   };
// kRetired, where there is one, holds names that were once in the list, with their remedies.
template <class Enum>
struct Names;

template <class Enum>
concept NamedEnum = requires {
  Names<Enum>::kList;
};

template <NamedEnum Enum>
constexpr std::string_view NameOf(Enum value) {
  for (const auto& [name, named] : Names<Enum>::kList) {
    if (named == value) return name;
  }
  return "?";
}

// Passed to Visit to ask only whether it exists.
struct NoVisitor {
  template <class T>
  void operator()(std::string_view, T&, FieldInfo = {}) const {}
};

template <class T>
concept Visitable = requires(T& value) {
  T::Visit(value, NoVisitor{});
};

}  // namespace talus::base
