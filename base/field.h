// What a `Visit` list says of each of its fields: one list serves the JSON reader, the writer, the
// JSON Schema and the hash that a resumed campaign is checked with.
//
//   template <class Self, class Visitor>
//   static void Visit(Self& self, Visitor&& visit) {
//     visit("density", self.density, {.dimension = Dimension::kDensity, .required = true,
//                                     .doc = "solid density of a grain, > 0"});
//   }
//
// Where there is no more to say of the fields than their names, TALUS_FIELDS lists them:
//
//   static constexpr base::FieldKey kKeys[] = {{"elapsed", "elapsed_s"}};  // keys carry units
//   TALUS_FIELDS(num_trials, num_failed, elapsed);
//
// A field is a bool, an integer, a double, a string, a path, an enum that has Names, another struct
// with Visit, a std::optional or a std::vector of one of these, or a base::Vec3.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/enumerators.h"
#include "base/units.h"

namespace talus::base {

struct FieldInfo {
  Dimension dimension = Dimension::kNone;
  bool required = false;     // a file without the key is an error
  const char* doc = "";      // what it is, its unit and range: shown by editors from the schema
  const char* unit_of = "";  // a key beside it, or its own: base/json/json_units.h
};

// A field whose key is not its own name.
struct FieldKey {
  std::string_view field;
  std::string_view key;
};

// The key of the first of `names`, "name, value", which is taken off.
template <class Owner>
constexpr std::string_view TakeKey(std::string_view& names) {
  const std::string_view name = names.substr(0, names.find(','));
  names.remove_prefix(std::min(names.size(), name.size() + 2));
  if constexpr (requires { Owner::kKeys; }) {
    for (const FieldKey& renamed : Owner::kKeys) {
      if (renamed.field == name) return renamed.key;
    }
  }
  return name;
}

// Whether each of the owner's kKeys is of a field in `names`.
template <class Owner>
constexpr bool HasItsKeys(std::string_view names) {
  if constexpr (requires { Owner::kKeys; }) {
    std::size_t num_renamed = 0;
    while (!names.empty()) {
      const std::string_view name = names.substr(0, names.find(','));
      num_renamed += TakeKey<Owner>(names) != name ? 1 : 0;
    }
    return num_renamed == std::size(Owner::kKeys);
  }
  return true;
}

// The list alone, for a struct whose own Visit calls VisitFields and has more to say.
#define TALUS_FIELD_LIST(...)                                                                 \
  template <class Each>                                                                       \
  void WithFields(Each&& each) {                                                              \
    each(__VA_ARGS__);                                                                        \
  }                                                                                           \
  template <class Each>                                                                       \
  void WithFields(Each&& each) const {                                                        \
    each(__VA_ARGS__);                                                                        \
  }                                                                                           \
  template <class Self, class Visitor>                                                        \
  static void VisitFields(Self& self, Visitor&& visit) {                                      \
    static_assert(::talus::base::HasItsKeys<Self>(#__VA_ARGS__));                             \
    std::string_view names = #__VA_ARGS__;                                                    \
    self.WithFields(                                                                          \
        [&](auto&... fields) { (visit(::talus::base::TakeKey<Self>(names), fields), ...); }); \
  }                                                                                           \
  static_assert(true)

#define TALUS_FIELDS(...)                          \
  TALUS_FIELD_LIST(__VA_ARGS__);                   \
  template <class Self, class Visitor>             \
  static void Visit(Self& self, Visitor&& visit) { \
    VisitFields(self, visit);                      \
  }                                                \
  static_assert(true)

// The names of an enum as they stand in JSON: those of its enumerators (base/enumerators.h) where
// a function beside it names the last, kLeftOut being "left_out":
//   constexpr AlarmKind LastOf(AlarmKind) { return AlarmKind::kLeftOut; }
// Others are listed, beside the enum:
//   template <> struct base::Names<Rolling> {
//     static constexpr std::array kList{std::pair{"none", Rolling::kNone}, …};
//   };
// kRetired, where there is one, holds names that were once in the list, with their remedies.
template <class Enum>
struct Names;

template <class Enum>
requires requires(Enum value) { LastOf(value); }
struct Names<Enum> {
  static constexpr auto kList = EnumeratorNames<LastOf(Enum{})>();
};

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

template <NamedEnum Enum>
constexpr std::optional<Enum> EnumNamed(std::string_view name) {
  for (const auto& [known, value] : Names<Enum>::kList) {
    if (known == name) return value;
  }
  return std::nullopt;
}

template <NamedEnum Enum>
std::vector<std::string> NamesOf() {
  std::vector<std::string> names;
  for (const auto& [name, value] : Names<Enum>::kList) names.emplace_back(name);
  return names;
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
