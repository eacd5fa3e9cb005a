// One function a code: the card's lines, with what the code defines in another way converted, and a
// comment where it has nothing that does the same.
#pragma once

#include <string>

#include "experiments/analysis/card/card.h"

namespace talus::analysis {

std::string TableCard(const Card& card);
std::string JsonCard(const Card& card);
std::string LetheCard(const Card& card);
std::string LiggghtsCard(const Card& card);
std::string LammpsCard(const Card& card);
std::string YadeCard(const Card& card);
std::string MercuryDpmCard(const Card& card);

// Six significant digits, as the codes read numbers: "2.625e+07".
std::string CardNumber(double value);

// ", 90 %: 0.2 ... 0.4 (prior 0.35 ± 0.05)"; "" of one draw.
std::string CardRangeText(const CardRange& range);

// What the values hold for, one line each, behind `mark` ("# ", "// ").
std::string CardHead(const Card& card, const std::string& code, const std::string& mark);

// "heap: tube of 10 mm lifted at 50 mm/s off a plate of 10 mm", "mixer: drum, diameter 0.024 m, …".
std::string TestText(const CardTest& test);

// "" of the first test, "2" of the second: what distinguishes the commands of one from the other's.
std::string TestMark(const Card& card, const CardTest& test);

// Which pairs with the material of this index or a later one state something themselves, for a code
// that has no place for it; a line each behind `mark`.
std::string PairsNotIncluded(const Card& card, int first_material, const std::string& mark);

// Which walls are not as the powder, and in what, for a code whose lines are of the powder alone; a
// line each behind `mark`.
std::string WallsNotIncluded(const Card& card, const std::string& mark);

// That a code does not have the rolling resistance; a line behind `mark`.
std::string RollingNotIncluded(const Card& card, const std::string& code, const std::string& mark);

// The restitution that `damping tsuji` of LAMMPS must be given to rebound with `restitution`, and
// its polynomial α(e) (docs/foreign_engines.md).
double TsujiAlpha(double restitution);
double TsujiRestitution(double restitution);

}  // namespace talus::analysis
