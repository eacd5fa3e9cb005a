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
#include "base/json/json_text.h"
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

// The text of a whole file: JsonText(ToJson(value), 2) with a line feed, made piece by piece, as
// the document of a scene of a million spheres takes gigabytes.
class JsonTextWriter {
 public:
  template <class T>
  static std::string TextOf(const T& value) {
    JsonTextWriter writer;
    writer.Write(value);
    return std::move(writer.text_) + "\n";
  }

  template <class T>
  void operator()(std::string_view key, const T& field, FieldInfo = {}) {
    NextLine();
    text_ += '"';
    text_ += key;  // a key of ours, which needs no escape
    text_ += "\": ";
    Write(field);
  }
  template <class T>
  void operator()(std::string_view key, const std::optional<T>& field, FieldInfo = {}) {
    if (field) (*this)(key, *field);
  }

 private:
  void NextLine() {
    text_ += empty_ ? "\n" : ",\n";
    text_.append(indent_, ' ');
    empty_ = false;
  }
  // Runs `body`, which calls NextLine before each member.
  template <class Body>
  void Nest(char open, char close, Body&& body) {
    text_ += open;
    indent_ += 2;
    empty_ = true;
    body();
    indent_ -= 2;
    if (!empty_) {
      text_ += '\n';
      text_.append(indent_, ' ');
    }
    empty_ = false;
    text_ += close;
  }
  template <class T>
  void Write(const T& value) {
    if constexpr (Visitable<T>) {
      Nest('{', '}', [&] { T::Visit(value, *this); });
    } else if constexpr (IsVector<T>::value) {
      Nest('[', ']', [&] {
        for (const auto& element : value) {
          NextLine();
          Write(element);
        }
      });
    } else if constexpr (std::same_as<T, Vec3>) {
      Write(std::vector<double>{value.x, value.y, value.z});
    } else {
      text_ += JsonText(ToJson(value));
    }
  }

  std::string text_;
  std::size_t indent_ = 0;
  bool empty_ = true;
};

}  // namespace talus::base
