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

}  // namespace talus::analysis
