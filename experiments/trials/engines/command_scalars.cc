#include "experiments/trials/engines/command_scalars.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/files/file.h"
#include "base/text/number_text.h"
#include "base/trimmed.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

constexpr const char* kJson = "scalars.json";
constexpr const char* kCsv = "scalars.csv";
constexpr std::uint64_t kMostBytes = 1 << 20;  // ten thousand numbers
constexpr std::size_t kMostQuoted = 200;       // bytes of a line

journal::MetricRecord ScalarOf(const std::string& name, std::optional<double> value) {
  journal::MetricRecord scalar{.name = name, .unit = rigs::UnitOfObservable(name), .undefined = {}};
  if (value && std::isfinite(*value)) {
    scalar.value = *value;
  } else {
    scalar.undefined = "the command gives no value";
  }
  return scalar;
}

// Masses, lengths, times and most others are not negative; a share has a most, an angle both.
void RequirePossible(const std::string& file, const std::vector<journal::MetricRecord>& scalars) {
  constexpr double kRounded = 1 + 1e-6;  // a number that is printed with six digits
  for (const journal::MetricRecord& scalar : scalars) {
    if (!scalar.undefined.empty()) continue;
    const auto [low, high] = rigs::BoundsOf(scalar.name);
    const std::string what = "left " + file + " with \"" + scalar.name + "\" " +
                             base::ShortNumber(scalar.value) + ", which cannot be ";
    if (low == 0 && scalar.value < 0) {
      throw base::Error(what + "negative; write null for no value");
    }
    if (scalar.value >= low * kRounded && scalar.value <= high * kRounded) continue;
    throw base::Error(what +
                      (scalar.value < low ? "below " + base::ShortNumber(low)
                                          : "above " + base::ShortNumber(high)) +
                      "; write null for no value");
  }
}

std::string Unquoted(const std::string& text) {
  return std::string(base::Trimmed(text, " \t\r\""));
}

// Nobody can tell which of the two values is meant.
[[noreturn]] void ThrowTwice(const char* file, const std::string& name) {
  throw base::Error("left " + std::string(file) + " with \"" + name.substr(0, kMostQuoted) +
                    "\" twice");
}

// Refuses a key that stands there twice, of which the parser would keep the last.
nlohmann::json ParseOnce(const std::string& text) {
  std::set<std::string> names;
  const auto look = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    if (depth != 1 || event != nlohmann::json::parse_event_t::key) return true;
    const auto [name, is_new] = names.insert(parsed.get<std::string>());
    if (!is_new) ThrowTwice(kJson, *name);
    return true;
  };
  return nlohmann::json::parse(text, look, false);
}

}  // namespace

std::vector<journal::MetricRecord> ParseJsonScalars(const std::string& text) {
  const auto root = ParseOnce(text);
  if (!root.is_object()) {
    const bool nan =
        text.find("NaN") != std::string::npos || text.find("Infinity") != std::string::npos;
    throw base::Error(std::string("left a scalars.json that is no JSON object") +
                      (nan ? ": JSON has no NaN and no Infinity; write null for no value" : ""));
  }
  std::vector<journal::MetricRecord> scalars;
  for (const auto& [name, value] : root.items()) {
    if (!value.is_number() && !value.is_null()) {
      throw base::Error("left scalars.json with \"" + name + "\" that is no number");
    }
    scalars.push_back(
        ScalarOf(name, value.is_null() ? std::nullopt : std::optional(value.get<double>())));
  }
  return scalars;
}

// A first line "name,value" is a head.
std::vector<journal::MetricRecord> ParseCsvScalars(const std::string& text) {
  std::vector<journal::MetricRecord> scalars;
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::istringstream lines(text.substr(text.starts_with(kByteOrderMark) ? 3 : 0));
  std::set<std::string> names;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (Unquoted(line).empty()) continue;
    if (std::ranges::count(line, '"') % 2 != 0) {
      throw base::Error("left scalars.csv whose line " + std::to_string(number) +
                        " has a quote that is not closed: " + line.substr(0, kMostQuoted));
    }
    const auto comma = line.find(',');
    const std::string name = Unquoted(line.substr(0, comma));
    const std::string word = comma == std::string::npos ? "" : Unquoted(line.substr(comma + 1));
    if (number == 1 && word == "value") continue;
    double value = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = read.ec == std::errc() && read.ptr == word.data() + word.size();
    if (comma == std::string::npos || name.empty() || (!whole && !word.empty())) {
      throw base::Error("left scalars.csv whose line " + std::to_string(number) +
                        " is no name and number: " + line.substr(0, kMostQuoted));
    }
    if (!names.insert(name).second) ThrowTwice(kCsv, name);
    scalars.push_back(ScalarOf(name, whole ? std::optional(value) : std::nullopt));
  }
  return scalars;
}

fs::path ScalarFile(const fs::path& folder) {
  for (const char* name : {kJson, kCsv}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return {};
}

bool IsScalarName(const fs::path& name) { return name == kJson || name == kCsv; }

std::vector<journal::MetricRecord> ReadScalars(const fs::path& folder) {
  const fs::path file = ScalarFile(folder);
  if (file.empty()) return {};
  if (fs::exists(folder / kJson) && fs::exists(folder / kCsv)) {
    throw base::Error(
        "left both scalars.json and scalars.csv, and nobody can tell which is meant; "
        "leave one of them");
  }
  const std::string text = base::ReadFile(file, kMostBytes);
  std::vector<journal::MetricRecord> scalars =
      file.filename() == kJson ? ParseJsonScalars(text) : ParseCsvScalars(text);
  RequirePossible(file.filename(), scalars);
  return scalars;
}

void RemoveScalars(const fs::path& folder) {
  for (const char* name : {kJson, kCsv}) {
    std::error_code absent;
    fs::remove(folder / name, absent);
  }
}

}  // namespace talus::trials
