// Fills an options struct from JSON by walking its Visit list.
//
// Every problem is collected under its JSON path: wrong types, units that do not fit, unknown names
// of an enum, missing required keys, and unknown keys with the nearest known one.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/field.h"
#include "base/json/json_file.h"
#include "base/json/json_units.h"
#include "base/nearest.h"
#include "base/problems.h"
#include "base/text/joined.h"
#include "base/text/printable.h"
#include "base/vec3.h"

namespace talus::base {

// Where values come from: the folder that relative paths start at, and who collects the problems.
struct ReadContext {
  Problems& problems;
  std::filesystem::path folder;
};

class JsonReader {
 public:
  JsonReader(const nlohmann::json& object, const ReadContext& context)
      : object_(object), context_(context) {}

  template <class T>
  void operator()(std::string_view key, T& field, FieldInfo info = {}) {
    known_.emplace_back(key);
    const auto found = object_.find(std::string(key));
    if (found == object_.end()) {
      if (info.required) context_.problems.AddUnread(key, "is missing");
      return;
    }
    context_.problems.Within(key, [&] {
      Read(*found, field, info);
      RequireUnits(object_, *found, info.unit_of, context_.problems);
    });
  }

  // Reports the keys that no call has named. A key that starts with `$` (such as `$schema`) is
  // free.
  void ReportUnknownKeys() {
    for (const auto& [key, value] : object_.items()) {
      if (key.starts_with('$') || std::find(known_.begin(), known_.end(), key) != known_.end()) {
        continue;
      }
      const std::string meant = DidYouMean(key, known_);
      context_.problems.Add(
          key, "is not known here" + (meant.empty() ? "; there are " + Listed(known_) : meant));
    }
  }

 private:
  using json = nlohmann::json;

  void Expect(const char* what) { context_.problems.AddUnread("", std::string("must be ") + what); }

  void Read(const json& value, bool& field, const FieldInfo&) {
    if (!value.is_boolean()) return Expect("true or false");
    field = value.get<bool>();
  }
  template <std::integral T>
  void Read(const json& value, T& field, const FieldInfo&) {
    if (const std::optional<T> number = WholeNumber<T>(value)) {
      field = *number;
      return;
    }
    std::string range;
    if (std::is_unsigned_v<T>) range = ", 0 or more";
    if (sizeof(T) < sizeof(std::int64_t)) {
      range = " from " + std::to_string(std::numeric_limits<T>::min()) + " to " +
              std::to_string(std::numeric_limits<T>::max());
    }
    context_.problems.AddUnread("", "must be a whole number" + range);
  }
  // 2e6 is one, too.
  template <std::integral T>
  static std::optional<T> WholeNumber(const json& value) {
    constexpr double kExact = 9007199254740992;  // 2^53: up to here each has a double of its own
    std::optional<std::int64_t> number;
    if (value.is_number_unsigned()) {
      const auto positive = value.get<std::uint64_t>();
      return std::in_range<T>(positive) ? std::optional(static_cast<T>(positive)) : std::nullopt;
    }
    if (value.is_number_integer()) {
      number = value.get<std::int64_t>();
    } else if (value.is_number_float()) {
      const auto real = value.get<double>();
      if (std::abs(real) <= kExact && std::trunc(real) == real) {
        number = static_cast<std::int64_t>(real);
      }
    }
    if (!number || !std::in_range<T>(*number)) return std::nullopt;
    return static_cast<T>(*number);
  }
  void Read(const json& value, double& field, const FieldInfo& info) {
    if (value.is_number()) {
      field = value.get<double>();
    } else if (value.is_string()) {
      try {
        field = ParseQuantity(value.get_ref<const std::string&>(), info.dimension);
      } catch (const ConfigError& error) {
        context_.problems.AddUnread("", error.what());
      }
    } else {
      Expect("a number, or a text with a unit");
    }
  }
  void Read(const json& value, std::string& field, const FieldInfo&) {
    if (!value.is_string()) return Expect("a text");
    field = value.get<std::string>();
  }
  void Read(const json& value, std::filesystem::path& field, const FieldInfo&) {
    if (!value.is_string()) return Expect("a path");
    field = context_.folder / value.get<std::string>();
    // What is read is written again, into copies of the spec and the journal.
    if (!IsUtf8(field.string())) {
      context_.problems.Add("", "is read from \"" + context_.folder.string() +
                                    "\", whose name is not UTF-8; rename that folder");
    }
  }
  void Read(const json& value, Vec3& field, const FieldInfo& info) {
    if (!value.is_array() || value.size() != 3) return Expect("a list of three numbers");
    double* parts[] = {&field.x, &field.y, &field.z};
    for (std::size_t i = 0; i < 3; ++i) {
      context_.problems.Within("[" + std::to_string(i) + "]",
                               [&] { Read(value[i], *parts[i], info); });
    }
  }
  template <NamedEnum T>
  void Read(const json& value, T& field, const FieldInfo&) {
    if (value.is_string()) {
      if (const auto named = EnumNamed<T>(value.get_ref<const std::string&>())) {
        field = *named;
        return;
      }
    }
    const std::vector<std::string> names = NamesOf<T>();
    const std::string all = "must be one of \"" + Joined(names, "\", \"") + "\"" +
                            (value.is_string() ? DidYouMean(value.get<std::string>(), names) : "");
    context_.problems.AddUnread("", RemedyOf<T>(value).value_or(all));
  }
  // What to write in place of a name that is no longer one.
  template <NamedEnum T>
  static std::optional<std::string> RemedyOf(const json& value) {
    if constexpr (requires { Names<T>::kRetired; }) {
      for (const auto& [name, remedy] : Names<T>::kRetired) {
        if (value.is_string() && value.get_ref<const std::string&>() == name) {
          return "\"" + std::string(name) + "\" " + remedy;
        }
      }
    }
    return std::nullopt;
  }
  template <class T>
  void Read(const json& value, std::optional<T>& field, const FieldInfo& info) {
    if (value.is_null()) {
      field.reset();
    } else {
      Read(value, field.emplace(), info);
    }
  }
  template <class T>
  void Read(const json& value, std::vector<T>& field, const FieldInfo& info) {
    if (!value.is_array()) return Expect("a list");
    field.clear();
    for (std::size_t i = 0; i < value.size(); ++i) {
      T element{};
      context_.problems.Within("[" + std::to_string(i) + "]",
                               [&] { Read(value[i], element, info); });
      field.push_back(std::move(element));
    }
  }
  template <Visitable T>
  void Read(const json& value, T& field, const FieldInfo&) {
    if (!value.is_object()) return Expect("an object { … }");
    JsonReader reader(value, context_);
    T::Visit(field, reader);
    reader.ReportUnknownKeys();
  }

  const json& object_;
  ReadContext context_;
  std::vector<std::string> known_;
};

// Calls Validate of a struct and of every struct within it, each under its JSON path.
class TreeValidator {
 public:
  explicit TreeValidator(Problems& problems) : problems_(problems) {}

  template <class T>
  void operator()(std::string_view key, const T& field, FieldInfo = {}) {
    if constexpr (Visitable<T>) {
      problems_.Within(key, [&] { Check(field); });
    }
  }
  template <class T>
  void operator()(std::string_view key, const std::optional<T>& field, FieldInfo = {}) {
    if (field) (*this)(key, *field);
  }
  template <class T>
  void operator()(std::string_view key, const std::vector<T>& field, FieldInfo = {}) {
    if constexpr (Visitable<T>) {
      for (std::size_t i = 0; i < field.size(); ++i) {
        (*this)(std::string(key) + "[" + std::to_string(i) + "]", field[i]);
      }
    }
  }
  template <Visitable T>
  void Check(const T& value) {
    T::Visit(value, *this);
    if constexpr (requires { value.Validate(problems_); }) value.Validate(problems_);
  }

 private:
  Problems& problems_;
};

// Reads `value` from a whole file's root into `options`, without validating it.
template <Visitable T>
void ReadOptions(const nlohmann::json& value, T& options, const ReadContext& context) {
  if (!value.is_object()) {
    context.problems.Add("", "must be an object { … }");
    return;
  }
  JsonReader reader(value, context);
  T::Visit(options, reader);
  reader.ReportUnknownKeys();
}

// The usual way in: a file into a struct, read and validated; throws one ConfigError with
// everything that is wrong.
template <Visitable T>
T LoadOptions(const JsonFile& file) {
  T options;
  Problems problems(file.path.string(), file.places);
  ReadOptions(file.root, options, {problems, file.path.parent_path()});
  TreeValidator(problems).Check(options);
  problems.ThrowIfAny();
  return options;
}

}  // namespace talus::base
