#include "base/json/json_scan.h"

#include <unordered_map>
#include <vector>

namespace talus::base {
namespace {

using nlohmann::json;

class PositionIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  PositionIterator(JsonPosition* position, std::size_t at) : position_(position), at_(at) {}
  reference operator*() const { return position_->text[at_]; }
  PositionIterator& operator++() {
    ++at_;
    position_->Take();
    return *this;
  }
  PositionIterator operator++(int) {
    PositionIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const PositionIterator& o) const { return at_ == o.at_; }

 private:
  JsonPosition* position_;
  std::size_t at_;
};

using Places = std::unordered_map<std::string, Location>;

// The path and all it lies in: "a", "a.b", "a.b[3]". A key may hold a dot: then some of these name
// nothing, which does no harm.
void AddWithOuter(std::string_view path, Places& places) {
  places.try_emplace("");
  while (!path.empty()) {
    places.try_emplace(std::string(path));
    const auto cut = path.find_last_of(".[");
    path = cut == std::string_view::npos ? std::string_view() : path.substr(0, cut);
  }
}

// Notes the places of the values that are asked for, and builds the paths of no others than these
// and their siblings.
class PlaceFinder : public JsonEvents {
 public:
  PlaceFinder(const JsonPosition& position, Places& places)
      : position_(position), places_(places) {}

  bool null() override { return Value(position_.WordStart()); }
  bool boolean(bool) override { return Value(position_.WordStart()); }
  bool number_integer(number_integer_t) override { return Value(position_.NumberStart()); }
  bool number_unsigned(number_unsigned_t) override { return Value(position_.NumberStart()); }
  bool number_float(number_float_t, const string_t&) override {
    return Value(position_.NumberStart());
  }
  bool string(string_t& value) override {
    std::string path;
    const std::size_t longest_quantity = 40;
    if (Note(position_.StringStart(), &path) && value.size() <= longest_quantity) {
      places_[path].written = value;
    }
    return true;
  }
  bool start_object(std::size_t) override { return Open(false); }
  bool start_array(std::size_t) override { return Open(true); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }
  bool key(string_t& value) override {
    if (levels_.back().wanted) levels_.back().key = value;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;
  }

 private:
  struct Level {
    bool wanted = false;  // something in it is asked for
    bool is_array = false;
    std::size_t count = 0;  // of elements so far
    std::string path{};
    std::string key{};
  };

  std::string PathOfNext() const {
    const Level& level = levels_.back();
    if (level.is_array) return level.path + "[" + std::to_string(level.count) + "]";
    return level.path.empty() ? level.key : level.path + "." + level.key;
  }
  // Whether this value is asked for, or something in it.
  bool Note(std::size_t start, std::string* path) {
    if (!levels_.empty() && !levels_.back().wanted) return false;
    if (!levels_.empty()) {
      *path = PathOfNext();
      ++levels_.back().count;
    }
    const auto found = places_.find(*path);
    if (found == places_.end()) return false;
    found->second = position_.At(start);
    return true;
  }
  bool Value(std::size_t start) {
    std::string path;
    Note(start, &path);
    return true;
  }
  bool Open(bool is_array) {
    std::string path;
    const bool wanted = Note(position_.taken - 1, &path);
    levels_.push_back({.wanted = wanted, .is_array = is_array, .count = 0, .path = path});
    return true;
  }
  bool Close() {
    levels_.pop_back();
    return true;
  }

  const JsonPosition& position_;
  Places& places_;
  std::vector<Level> levels_;
};

Location PlaceOf(std::string_view path, const Places& places) {
  while (true) {
    const auto found = places.find(std::string(path));
    if (found != places.end() && found->second.line > 0) return found->second;
    if (path.empty()) return {};
    const auto cut = path.find_last_of(".[");
    path = cut == std::string_view::npos ? std::string_view() : path.substr(0, cut);
  }
}

}  // namespace

Location JsonPosition::At(std::size_t offset) const {
  const bool this_line = offset >= line_start;
  return {.line = this_line ? line : line - 1,
          .column = static_cast<int>(offset - (this_line ? line_start : previous_start) + 1)};
}

// The token ends at the last character taken; a number is followed by one that was only looked at.
std::size_t JsonPosition::StringStart() const {
  std::size_t start = taken - 1;  // the closing quote
  while (start > 0) {
    --start;
    if (text[start] != '"') continue;
    std::size_t slashes = 0;
    while (slashes < start && text[start - 1 - slashes] == '\\') ++slashes;
    if (slashes % 2 == 0) break;
  }
  return start;
}

std::size_t JsonPosition::StartOf(std::string_view letters) const {
  std::size_t start = taken;
  if (start > 0 && letters.find(text[start - 1]) == std::string_view::npos) --start;
  while (start > 0 && letters.find(text[start - 1]) != std::string_view::npos) --start;
  return start;
}

bool ScanJson(JsonPosition& position, JsonEvents& events) {
  position = {.text = position.text};
  return json::sax_parse(PositionIterator(&position, 0),
                         PositionIterator(&position, position.text.size()), &events,
                         nlohmann::detail::input_format_t::json, true, /*ignore_comments=*/true);
}

std::vector<Location> FindJsonPlaces(std::string_view text, std::span<const std::string> paths) {
  Places places;
  for (const std::string& path : paths) AddWithOuter(path, places);
  JsonPosition position{.text = text};
  PlaceFinder finder(position, places);
  ScanJson(position, finder);
  std::vector<Location> found;
  for (const std::string& path : paths) found.push_back(PlaceOf(path, places));
  return found;
}

}  // namespace talus::base
