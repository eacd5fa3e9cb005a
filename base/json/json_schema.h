// The JSON Schema (draft-07) of an options struct, made from its Visit list, so that editors
// complete the file and the schema cannot drift from the parser.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/json/json_writer.h"
#include "base/vec3.h"

namespace talus::base {

// `stated`: the value that an enclosing struct gives it, whose members are the defaults; null: its
// own.
template <class T>
nlohmann::ordered_json SchemaOf(const FieldInfo& info, const T* stated = nullptr);

class SchemaWriter {
 public:
  template <class T>
  void operator()(std::string_view key, const T& field, FieldInfo info = {}) {
    auto schema = SchemaOf<T>(info, &field);
    if constexpr (!Visitable<T>) {
      if (!info.required) AddDefault(schema, field);
    }
    properties_[std::string(key)] = std::move(schema);
    if (info.required) required_.push_back(std::string(key));
  }

  nlohmann::ordered_json Take() {
    nlohmann::ordered_json schema;
    schema["type"] = "object";
    schema["properties"] = std::move(properties_);
    schema["patternProperties"] = {{"^\\$", true}};
    schema["additionalProperties"] = false;
    if (!required_.empty()) schema["required"] = std::move(required_);
    return schema;
  }

 private:
  template <class T>
  static void AddDefault(nlohmann::ordered_json& schema, const T& field) {
    auto value = ToJson(field);
    if (!value.is_null()) schema["default"] = std::move(value);
  }
  template <class T>
  static void AddDefault(nlohmann::ordered_json&, const std::optional<T>&) {}

  nlohmann::ordered_json properties_ = nlohmann::ordered_json::object();
  std::vector<std::string> required_;
};

// A struct whose keys depend on its `kind`: one value of each.
template <class T>
concept HasAlternatives = requires {
  { T::Alternatives() } -> std::same_as<std::vector<T>>;
};

template <class T>
struct Element {
  using Type = void;
};
template <class T>
struct Element<std::vector<T>> {
  using Type = T;
};
template <class T>
struct Element<std::optional<T>> {
  using Type = T;
};

template <class T>
nlohmann::ordered_json SchemaOf(const FieldInfo& info, [[maybe_unused]] const T* stated) {
  using json = nlohmann::ordered_json;
  json schema;
  if constexpr (HasAlternatives<T>) {
    json all = json::array();
    for (const T& alternative : T::Alternatives()) {
      SchemaWriter writer;
      T::Visit(alternative, writer);
      json one = writer.Take();
      const std::string kind(NameOf(alternative.kind));
      one["title"] = kind;
      one["properties"]["kind"] = {{"const", kind}};
      all.push_back(std::move(one));
    }
    schema["oneOf"] = std::move(all);
  } else if constexpr (Visitable<T>) {
    SchemaWriter writer;
    static const T defaults{};  // on the stack GCC 12 takes its optionals for uninitialised
    T::Visit(stated != nullptr ? *stated : defaults, writer);
    schema = writer.Take();
  } else if constexpr (NamedEnum<T>) {
    json names = json::array();
    for (const auto& [name, value] : Names<T>::kList) names.push_back(std::string(name));
    schema["enum"] = std::move(names);
  } else if constexpr (std::same_as<T, bool>) {
    schema["type"] = "boolean";
  } else if constexpr (std::integral<T>) {
    schema["type"] = "integer";
  } else if constexpr (std::floating_point<T>) {
    schema["type"] = json::array({"number", "string"});
  } else if constexpr (std::same_as<T, Vec3>) {
    schema["type"] = "array";
    schema["items"] = {{"type", json::array({"number", "string"})}};
    schema["minItems"] = 3;
    schema["maxItems"] = 3;
  } else if constexpr (IsVector<T>::value) {
    schema["type"] = "array";
    FieldInfo element = info;
    element.doc = "";
    schema["items"] = SchemaOf<typename Element<T>::Type>(element);
  } else if constexpr (!std::same_as<typename Element<T>::Type, void>) {
    return SchemaOf<typename Element<T>::Type>(info);
  } else {
    schema["type"] = "string";
  }
  std::string doc = info.doc;
  if (info.dimension != Dimension::kNone) {
    doc += (doc.empty() ? "[" : " [") + std::string(SiUnit(info.dimension)) + "]";
  }
  if (!doc.empty()) schema["description"] = doc;
  return schema;
}

// The whole schema of a file.
template <Visitable T>
nlohmann::ordered_json FileSchema(const std::string& title) {
  nlohmann::ordered_json schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = title;
  schema.update(SchemaOf<T>({}));
  return schema;
}

}  // namespace talus::base
