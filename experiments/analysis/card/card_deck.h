// The card of a set that was calibrated with another engine's deck: what the deck was given, by the
// names of its placeholders. What they mean is the deck's own, so that nothing is converted.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/card/card.h"
#include "experiments/rigs/case/case.h"
#include "experiments/trials/engines/command_options.h"

namespace talus::analysis {

// `names`: the placeholders that count, such as the calibrated parameters'.
CardDeck DeckOf(const trials::CommandOptions& engine, const rigs::Case& rig_case,
                const std::vector<std::string>& names);

// The names of the powder's own properties, of a case of which nobody says what is calibrated.
std::vector<std::string> PowderPlaceholders();

// As CardText does it: comments of the format's code, a table, or JSON. `card.deck` must be there.
std::string DeckCardText(const Card& card, CardFormat format);

}  // namespace talus::analysis
