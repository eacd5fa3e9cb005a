#include "experiments/rigs/observables/shown_number.h"

#include <array>
#include <utility>

#include "base/text/lower.h"
#include "base/text/number_text.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::rigs {
namespace {

using Entry = std::pair<std::string_view, std::string_view>;

template <std::size_t N>
std::string Translated(const std::array<Entry, N>& list, std::string_view key) {
  for (const auto& [name, text] : list) {
    if (name == key) return std::string(text);
  }
  return std::string(key);
}

}  // namespace

std::string PrettyUnit(std::string_view unit) {
  static constexpr std::array kUnits{
      Entry{"mm2", "mm²"},          Entry{"deg", "°"},       Entry{"-", ""},
      Entry{"gray", "grey levels"}, Entry{"J/m^2", "J/m²"},  Entry{"kg/m^3", "kg/m³"},
      Entry{"kg/m3", "kg/m³"},      Entry{"kg/m2", "kg/m²"},
  };
  return Translated(kUnits, unit);
}

ShownUnit ShownUnitOf(std::string_view unit) {
  if (unit == "kg") return {"mg", 1e6};
  if (unit == "m") return {"mm", 1e3};
  if (unit == "kg/s") return {"g/s", 1e3};
  return {PrettyUnit(unit), 1};
}

std::string ShownName(const std::string& metric) {
  const ObservableInfo* info = FindObservable(metric);
  if (info == nullptr) return metric;
  static constexpr std::array kEndings{Entry{"_kg", "_mg"}, Entry{"_m", "_mm"},
                                       Entry{"_kg_per_s", "_g_per_s"}};
  return info->key + Translated(kEndings, MetricUnitOf(info->dimension).ending);
}

std::string SpokenName(const std::string& metric) {
  const ObservableInfo* info = FindObservable(metric);
  if (info == nullptr) return metric;
  return base::LowerFirst(info->title);
}

double Possible(std::string_view metric, double value) { return BoundsOf(metric).Clamp(value); }

std::string ShownNumber(std::string_view metric, double value, int digits) {
  const ShownUnit unit = ShownUnitOf(UnitOfObservable(metric));
  return base::ShortNumber(unit.per_unit * Possible(metric, value), digits) +
         (unit.text.empty() || unit.text == "°" ? "" : " ") + unit.text;
}

}  // namespace talus::rigs
