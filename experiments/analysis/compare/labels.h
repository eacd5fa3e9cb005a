// How parameters and metrics are called for people.
#pragma once

#include <string>
#include <string_view>

#include "experiments/rigs/observables/shown_number.h"

namespace talus::analysis {

// "sliding_friction" → "μₜ"; a name without a symbol of its own stays as it is.
std::string SymbolOf(std::string_view parameter);

// What the symbol stands for: "plate_pair_sliding_friction" → "sliding friction", since "μₜ
// powder–plate" names the bodies; empty for a name without a symbol.
std::string WordsOf(std::string_view parameter);

// "sliding friction μₜ"; a name without a symbol stays as it is.
std::string LongNameOf(std::string_view parameter);

// "repose_angle_2_mean_deg" → "AOR 2"; a metric without a title of its own stays as it is.
std::string MetricTitle(std::string_view metric);

using rigs::PrettyUnit;
using rigs::ShownName;
using rigs::ShownUnit;
using rigs::ShownUnitOf;

}  // namespace talus::analysis
