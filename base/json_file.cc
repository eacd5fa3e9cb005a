#include "base/json_file.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "base/error.h"
#include "base/file.h"

namespace talus::base {
namespace {

using nlohmann::json;

// Feeds the parser and counts what it has taken, which tells where the token it reports ended.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* taken) : at_(at), taken_(taken) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*taken_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& o) const { return at_ == o.at_; }

 private:
  const char* at_;
  std::size_t* taken_;
};

Location LocationOf(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line_start = before.rfind('\n');
  return {.line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          .column = static_cast<int>(
              offset - (line_start == std::string_view::npos ? 0 : line_start + 1) + 1)};
}

// Builds the document from the parser's events and notes where each value starts.
class Builder : public json::json_sax_t {
 public:
  Builder(std::string_view text, const std::size_t* taken, JsonFile* file, Problems* problems)
      : text_(text), taken_(taken), file_(file), problems_(problems) {}

  bool null() override { return Value(nullptr, WordStart()); }
  bool boolean(bool value) override { return Value(value, WordStart()); }
  bool number_integer(number_integer_t value) override { return Value(value, NumberStart()); }
  bool number_unsigned(number_unsigned_t value) override { return Value(value, NumberStart()); }
  bool number_float(number_float_t value, const string_t&) override {
    return Value(value, NumberStart());
  }
  bool string(string_t& value) override { return Value(std::move(value), StringStart()); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return Open(json::object()); }
  bool start_array(std::size_t) override { return Open(json::array()); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }

  bool key(string_t& value) override {
    Level& level = levels_.back();
    level.key = value;
    if (level.node->contains(value)) {
      file_->source.emplace(PathOfNext(), LocationOf(text_, StringStart()));
      problems_->Add(PathOfNext(), "is given twice; keep one");
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const json::exception& error) override {
    error_offset_ = position == 0 ? 0 : std::min(position - 1, text_.size());
    error_ = error.what();
    return false;
  }

  const std::string& error() const { return error_; }
  std::size_t error_offset() const { return error_offset_; }

 private:
  struct Level {
    json* node;
    std::string path;
    std::string key;
  };

  std::string PathOfNext() const {
    if (levels_.empty()) return "";
    const Level& level = levels_.back();
    if (level.node->is_array()) return level.path + "[" + std::to_string(level.node->size()) + "]";
    return level.path.empty() ? level.key : level.path + "." + level.key;
  }
  json* Attach(json&& value) {
    if (levels_.empty()) return &(file_->root = std::move(value));
    Level& level = levels_.back();
    if (level.node->is_array()) return &level.node->emplace_back(std::move(value));
    return &((*level.node)[level.key] = std::move(value));
  }
  bool Value(json&& value, std::size_t start) {
    file_->source.insert_or_assign(PathOfNext(), LocationOf(text_, start));
    Attach(std::move(value));
    return true;
  }
  bool Open(json&& empty) {
    const std::string path = PathOfNext();
    file_->source.insert_or_assign(path, LocationOf(text_, *taken_ - 1));
    json* node = Attach(std::move(empty));
    levels_.push_back({node, path, ""});
    return true;
  }
  bool Close() {
    levels_.pop_back();
    return true;
  }

  // The token ends at the last character taken; a number is followed by one that was only looked
  // at.
  std::size_t StringStart() const {
    std::size_t start = *taken_ - 1;  // the closing quote
    while (start > 0) {
      --start;
      if (text_[start] != '"') continue;
      std::size_t slashes = 0;
      while (slashes < start && text_[start - 1 - slashes] == '\\') ++slashes;
      if (slashes % 2 == 0) break;
    }
    return start;
  }
  std::size_t NumberStart() const { return StartOf("0123456789+-.eE"); }
  std::size_t WordStart() const { return StartOf("abcdefghijklmnopqrstuvwxyz"); }
  std::size_t StartOf(std::string_view letters) const {
    std::size_t start = *taken_;
    if (start > 0 && letters.find(text_[start - 1]) == std::string_view::npos) --start;
    while (start > 0 && letters.find(text_[start - 1]) != std::string_view::npos) --start;
    return start;
  }

  std::string_view text_;
  const std::size_t* taken_;
  JsonFile* file_;
  Problems* problems_;
  std::vector<Level> levels_;
  std::string error_;
  std::size_t error_offset_ = 0;
};

// "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while …" → what
// follows the position, which is reported in the form that all messages have.
std::string Reason(const std::string& what) {
  const auto cut = what.find(": ");
  return cut == std::string::npos ? what : what.substr(cut + 2);
}

}  // namespace

JsonFile ParseJson(std::string_view text, const std::filesystem::path& name) {
  JsonFile file{.path = name, .root = {}, .source = {}};
  Problems duplicates;
  std::size_t taken = 0;
  Builder builder(text, &taken, &file, &duplicates);
  const bool ok = json::sax_parse(CountingIterator(text.data(), &taken),
                                  CountingIterator(text.data() + text.size(), &taken), &builder,
                                  nlohmann::detail::input_format_t::json, true,
                                  /*ignore_comments=*/true);
  if (!ok) {
    const Location at = LocationOf(text, builder.error_offset());
    throw ConfigError(name.string() + ":" + std::to_string(at.line) + ":" +
                      std::to_string(at.column) + ": is not JSON: " + Reason(builder.error()));
  }
  Problems located(name.string(), file.source);
  for (const Problem& problem : duplicates.list()) located.Add(problem.path, problem.message);
  located.ThrowIfAny();
  return file;
}

JsonFile ReadJsonFile(const std::filesystem::path& path) { return ParseJson(ReadFile(path), path); }

}  // namespace talus::base
