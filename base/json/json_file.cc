#include "base/json/json_file.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_scan.h"

namespace talus::base {
namespace {

using nlohmann::json;

constexpr std::size_t kDeepest = 100;
constexpr std::uint64_t kLargestFile = 1ull << 29;  // 512 MiB; some ten times that in memory

// Builds the document from the parser's events.
class Builder : public JsonEvents {
 public:
  explicit Builder(const JsonPosition& position) : position_(position) {}

  bool null() override { return Value(nullptr); }
  bool boolean(bool value) override { return Value(value); }
  bool number_integer(number_integer_t value) override { return Value(value); }
  bool number_unsigned(number_unsigned_t value) override { return Value(value); }
  bool number_float(number_float_t value, const string_t&) override { return Value(value); }
  bool string(string_t& value) override { return Value(std::move(value)); }
  bool start_object(std::size_t) override { return Open(json::object()); }
  bool start_array(std::size_t) override { return Open(json::array()); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }

  bool key(string_t& value) override {
    Level& level = levels_.back();
    level.key = value;
    if (!level.node->contains(value)) return true;
    return Stop(position_.At(position_.StringStart()), Path() + ": is given twice; keep one");
  }
  bool parse_error(std::size_t position, const std::string&,
                   const json::exception& error) override {
    const std::size_t offset = std::min(position == 0 ? 0 : position - 1, position_.text.size());
    return Stop(position_.At(offset), "is not JSON: " + Reason(offset, error.what()));
  }

  json Take() { return std::move(root_); }
  Location place() const { return place_; }
  const std::string& reason() const { return reason_; }

 private:
  struct Level {
    json* node;
    std::string key;
  };

  bool Stop(Location place, std::string reason) {
    place_ = place;
    reason_ = std::move(reason);
    return false;
  }
  json* Attach(json&& value) {
    if (levels_.empty()) return &(root_ = std::move(value));
    Level& level = levels_.back();
    if (level.node->is_array()) return &level.node->emplace_back(std::move(value));
    return &((*level.node)[level.key] = std::move(value));
  }
  bool Value(json&& value) {
    Attach(std::move(value));
    return true;
  }
  bool Open(json&& empty) {
    if (levels_.size() >= kDeepest) {
      return Stop(position_.At(position_.taken - 1),
                  "lists and objects lie in each other more than " + std::to_string(kDeepest) +
                      " deep; no file of ours does that");
    }
    levels_.push_back({Attach(std::move(empty)), ""});
    return true;
  }
  bool Close() {
    levels_.pop_back();
    return true;
  }

  // The path of the key that has been read last.
  std::string Path() const {
    std::string path;
    for (const Level& level : levels_) {
      if (level.node->is_array()) {
        path += "[" + std::to_string(level.node->size() - 1) + "]";
      } else {
        path += (path.empty() ? "" : ".") + level.key;
      }
    }
    return path;
  }
  std::string Reason(std::size_t offset, std::string_view what) const;
  std::string WrongToken(std::size_t offset, std::string_view what) const;

  const JsonPosition& position_;
  json root_;
  std::vector<Level> levels_;
  Location place_;
  std::string reason_;
};

// What is wrong with a number that other programs write so and JSON does not know; empty where the
// character at `offset`, the last one read, belongs to none.
std::string NumberSlip(std::string_view text, std::size_t offset) {
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
  };
  if (text[offset] == '.' || text[offset] == '+') {
    return "a number begins with a digit or with -; write it as 0.5 or 1e-3";
  }
  if (!is_digit(offset)) return "";
  std::size_t start = offset;
  while (start > 0 && is_digit(start - 1)) --start;
  if (start >= 2 && text[start - 1] == ',' && is_digit(start - 2)) {
    return "a number has a point before its decimals, not a comma";
  }
  return start < offset && text[start] == '0' ? "a number of several digits does not begin with 0"
                                              : "";
}

// What the parser says, told in a user's words. Its own are of tokens and grammar.
std::string Builder::Reason(std::size_t offset, std::string_view what) const {
  const auto says = [&](std::string_view part) { return what.find(part) != what.npos; };
  const std::string_view text = position_.text;
  if (text.find_first_not_of(" \t\r\n") == text.npos) return "it is empty";
  if (says("number overflow")) return "a number is too large for a computer";
  if (says("ill-formed UTF-8")) return "a text is not UTF-8; save the file in that encoding";
  if (says("control character")) {
    return "a text holds a line break or a control character; is its closing quote missing?";
  }
  if (says("invalid comment")) return "a comment is // to the end of the line, or /* … */";
  if (offset >= text.size()) return "it ends too early: a bracket or a quote is not closed";
  if (says("invalid string")) {
    return "a backslash in a text must be doubled, or stand before one of \" \\ / b f n r t u";
  }
  if (says("invalid number")) return "a number is not complete; write it as 0.5 or 1e-3";
  return WrongToken(offset, what);
}

std::string Builder::WrongToken(std::size_t offset, std::string_view what) const {
  const auto says = [&](std::string_view part) { return what.find(part) != what.npos; };
  const std::string_view text = position_.text;
  const std::size_t before = offset == 0 ? text.npos : text.find_last_not_of(" \t\r\n", offset - 1);
  if (const std::string slip = NumberSlip(text, offset); !slip.empty()) return slip;
  const bool closes = text[offset] == '}' || text[offset] == ']';
  if (closes && before != text.npos && text[before] == ',') {
    return "a comma stands before the closing bracket; take it out";
  }
  if (says("invalid literal")) {
    return "texts and keys stand in double quotes, and a value is a text, a number, true, false, "
           "null, a list [ … ] or an object { … }";
  }
  if (says("object separator")) return "a colon is missing between a key and its value";
  if (says("object key")) return "a key in double quotes is expected here";
  if (says("parsing object")) return "a comma or } is missing before this";
  if (says("parsing array")) return "a comma or ] is missing before this";
  if (says("expected end of input")) return "more follows after its end; is a bracket too many?";
  return "a value is missing before this";
}

JsonFile Parse(std::shared_ptr<const std::string> text, const std::filesystem::path& name) {
  JsonPosition position{.text = *text};
  Builder builder(position);
  if (!ScanJson(position, builder)) {
    const Location at = builder.place();
    throw ConfigError(name.string() + ":" + std::to_string(at.line) + ":" +
                      std::to_string(at.column) + ": " + builder.reason());
  }
  return {.path = name,
          .root = builder.Take(),
          .places = [text = std::move(text)](std::span<const std::string> paths) {
            return FindJsonPlaces(*text, paths);
          }};
}

}  // namespace

JsonFile ParseJson(std::string_view text, const std::filesystem::path& name) {
  return Parse(std::make_shared<const std::string>(text), name);
}

JsonFile ReadJsonFile(const std::filesystem::path& path) {
  return Parse(std::make_shared<const std::string>(ReadFile(path, kLargestFile)), path);
}

std::string TextAt(const json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::int64_t IntegerAt(const json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
}

}  // namespace talus::base
