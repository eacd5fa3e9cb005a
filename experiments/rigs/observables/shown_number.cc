#include "experiments/rigs/observables/shown_number.h"

#include "base/text/key_text.h"
#include "base/text/lower.h"
#include "base/text/number_text.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::rigs {

std::string PrettyUnit(std::string_view unit) {
  static constexpr base::KeyText kUnits[]{
      {"mm2", "mm²"},    {"deg", "°"},        {"-", ""},          {"gray", "grey levels"},
      {"J/m^2", "J/m²"}, {"kg/m^3", "kg/m³"}, {"kg/m3", "kg/m³"}, {"kg/m2", "kg/m²"},
  };
  return base::TextOf(kUnits, unit);
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
  static constexpr base::KeyText kEndings[]{
      {"_kg", "_mg"}, {"_m", "_mm"}, {"_kg_per_s", "_g_per_s"}};
  return info->key + base::TextOf(kEndings, MetricUnitOf(info->dimension).ending);
}

std::string SpokenName(const std::string& metric) {
  const ObservableInfo* info = FindObservable(metric);
  if (info == nullptr) return metric;
  return base::LowerFirst(info->title);
}

double Possible(std::string_view metric, double value) { return BoundsOf(metric).Clamp(value); }

std::string ShownError(std::string_view metric, double error, int digits) {
  const ShownUnit unit = ShownUnitOf(UnitOfObservable(metric));
  return base::ShortNumber(unit.per_unit * error, digits) +
         (unit.text.empty() || unit.text == "°" ? "" : " ") + unit.text;
}

std::string ShownNumber(std::string_view metric, double value, int digits) {
  return ShownError(metric, Possible(metric, value), digits);
}

}  // namespace talus::rigs
