// What the page says of an answer, in words.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/analysis/compare/evidence.h"

namespace talus::analysis {

// campaign::Headline with symbols beside the names: "sliding friction μₜ".
std::vector<std::string> HeadlineWords(const Evidence& evidence);

// "3 × 10⁻⁵" in place of each "3e-05" of a text.
std::string WithPowers(const std::string& text);

// The two parameters that change together most, where they do so clearly, and how.
std::optional<std::pair<std::size_t, std::size_t>> TradedPair(const campaign::Answer& answer);
std::string TradeOffWords(const Evidence& evidence);

// The volume of the ranges after the simulations that a search whose budget ended it still asks
// for, over today's [-]; undefined where that is not known.
double VolumeThen(const campaign::Answer& answer);

// Whether to use the recommended set now.
std::string UseWords(const campaign::Answer& answer);

// The alarms, with the campaign's folder in their commands.
std::vector<std::string> AlarmWords(const Evidence& evidence);

// What the calibrated set holds for; and what it predicts of an experiment that is held out.
std::vector<std::string> ConditionWords(const campaign::ResultConditions& conditions);
std::vector<std::string> HeldOutWords(const campaign::Answer& answer);

}  // namespace talus::analysis
