// The tests of a card with what their walls are of: each of a campaign's may have walls of its own.
#pragma once

#include <string>

#include "experiments/analysis/card/card.h"

namespace talus::analysis {

// Adds a test, and what its walls are of where no test before has the same.
void AddTest(const rigs::Case& rig_case, const std::string& name, Card& card);

// "plate" where every test has the same, else "plate of drum".
void NameWalls(Card& card);

}  // namespace talus::analysis
