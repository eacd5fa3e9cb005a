// What limits a run's threads, for result.json.
#pragma once

#include <nlohmann/json.hpp>

#include "engine/scaling.h"

namespace talus::engine {

nlohmann::ordered_json ScalingJson(const ScalingEstimate& estimate);

}  // namespace talus::engine
