// Numbers whose unit was forgotten beside one that has it: {"value": "0.64 g/mL", "sd": 0.01} would
// be 640 ± 0.01 kg/m³, and {"value": "95 %", "sd": 2} 95 ± 200 %.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "base/problems.h"

namespace talus::base {

// Adds a problem for `value`, or for each entry of it where it is a list, that is a bare number
// while the text under `unit_of` in `object`, or an entry of the list there, has a unit. "" asks
// for nothing. A 0 needs no unit.
void RequireUnits(const nlohmann::json& object, const nlohmann::json& value,
                  std::string_view unit_of, Problems& problems);

}  // namespace talus::base
