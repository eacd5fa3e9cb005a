// What the cards of our own engine and of a deck have in common as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "experiments/analysis/card/card.h"

namespace talus::analysis {

// The calibrated values with their 90 % ranges.
nlohmann::ordered_json RangesJson(const Card& card);

// A test's name and device, without what its walls are of.
nlohmann::ordered_json TestJson(const CardTest& test);

}  // namespace talus::analysis
