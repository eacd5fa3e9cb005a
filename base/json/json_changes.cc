#include "base/json/json_changes.h"

#include <cmath>
#include <limits>

#include "base/json/json_text.h"
#include "base/text/number_text.h"
#include "base/text/printable.h"

namespace talus::base {
namespace {

using nlohmann::ordered_json;

std::string Short(const ordered_json& value) {
  std::string text = JsonText(value);
  if (text.size() <= 40) return text;
  text.resize(37);
  while (!IsUtf8(text)) text.pop_back();  // a character that was cut in two
  return text + "…";
}

// One quantity in two units, "1.602 g" and "1602 mg", is two numbers by a last digit or two.
bool IsTheSame(const ordered_json& before, const ordered_json& after) {
  if (before == after) return true;
  if (!before.is_number_float() || !after.is_number_float()) return false;
  const double from = before.get<double>();
  const double to = after.get<double>();
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  return std::abs(from - to) <= kRounding * std::abs(from);
}

// 0.001602 for 0.0016020000000000001, where the two still differ then.
void Shorten(const ordered_json& before, const ordered_json& after, JsonChange& change) {
  if (!before.is_number_float() || !after.is_number_float()) return;
  constexpr int kDigits = 6;
  const std::string from = ShortNumber(before.get<double>(), kDigits);
  const std::string to = ShortNumber(after.get<double>(), kDigits);
  if (from == to) return;
  change.before = from;
  change.after = to;
}

void FindChanges(const ordered_json& before, const ordered_json& after, const std::string& path,
                 std::vector<JsonChange>& changes) {
  if (IsTheSame(before, after)) return;
  if (before.is_array() && after.is_array() && before.size() == after.size()) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      FindChanges(before[i], after[i], path + "[" + std::to_string(i) + "]", changes);
    }
    return;
  }
  if (!before.is_object() || !after.is_object()) {
    changes.push_back({.path = path, .before = Short(before), .after = Short(after)});
    Shorten(before, after, changes.back());
    return;
  }
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [key, value] : before.items()) {
    const auto found = after.find(key);
    FindChanges(value, found == after.end() ? ordered_json() : *found, prefix + key, changes);
  }
  for (const auto& [key, value] : after.items()) {
    if (!before.contains(key)) FindChanges(ordered_json(), value, prefix + key, changes);
  }
}

}  // namespace

std::vector<JsonChange> JsonChanges(const ordered_json& before, const ordered_json& after) {
  std::vector<JsonChange> changes;
  FindChanges(before, after, "", changes);
  return changes;
}

}  // namespace talus::base
