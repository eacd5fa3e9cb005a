// How parameters and metrics are called for people.
#pragma once

#include <string>
#include <string_view>

namespace talus::analysis {

// "sliding_friction" → "μ_t"; a name without a symbol of its own stays as it is.
std::string SymbolOf(std::string_view parameter);

// "repose_angle_2_mean_deg" → "AOR 2"; a metric without a title of its own stays as it is.
std::string MetricTitle(std::string_view metric);

// "mm2" → "mm²", "deg" → "°", "J/m^2" → "J/m²", "-" → "".
std::string PrettyUnit(std::string_view unit);

// The unit that people read a metric in: milligrams of a heap, millimetres of a column.
struct ShownUnit {
  std::string text;     // "mg"
  double per_unit = 1;  // a number in it / the metric's value
};
ShownUnit ShownUnitOf(std::string_view unit);

// "mass_fallen_kg" → "mass_fallen_mg", which is read in milligrams.
std::string ShownName(const std::string& metric);

}  // namespace talus::analysis
