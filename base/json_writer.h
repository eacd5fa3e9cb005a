// Writes an options struct as JSON by walking its Visit list: what JsonReader reads back.
#pragma once

#include <cmath>
#include <concepts>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/vec3.h"

namespace talus::base {

template <class T>
nlohmann::ordered_json ToJson(const T& value);

class JsonWriter {
 public:
  template <class T>
  void operator()(std::string_view key, const T& field, FieldInfo = {}) {
    object_[std::string(key)] = ToJson(field);
  }
  template <class T>
  void operator()(std::string_view key, const std::optional<T>& field, FieldInfo = {}) {
    if (field) object_[std::string(key)] = ToJson(*field);
  }
  nlohmann::ordered_json Take() { return std::move(object_); }

 private:
  nlohmann::ordered_json object_ = nlohmann::ordered_json::object();
};

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};

// Numbers in SI; a number that is not finite becomes null, which JSON has and NaN it has not.
template <class T>
nlohmann::ordered_json ToJson(const T& value) {
  if constexpr (Visitable<T>) {
    JsonWriter writer;
    T::Visit(value, writer);
    return writer.Take();
  } else if constexpr (NamedEnum<T>) {
    return std::string(NameOf(value));
  } else if constexpr (std::same_as<T, Vec3>) {
    return {value.x, value.y, value.z};
  } else if constexpr (std::same_as<T, std::filesystem::path>) {
    return value.string();
  } else if constexpr (IsVector<T>::value) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& element : value) list.push_back(ToJson(element));
    return list;
  } else if constexpr (std::floating_point<T>) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  } else {
    return value;
  }
}

}  // namespace talus::base
