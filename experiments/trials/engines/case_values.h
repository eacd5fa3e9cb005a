// What the placeholders of a template mean for a case: docs/foreign_engines.md has the same list.
#pragma once

#include <string>
#include <vector>

#include "experiments/rigs/case/case.h"
#include "experiments/trials/engines/template_text.h"

namespace talus::trials {

// Every value, in SI. The table `grains` has its columns but no rows: see AddGrains.
TemplateValues CaseValues(const rigs::Case& rig_case);

// The placeholders of what the case's pairs state themselves, such as plate_pair_sliding_friction:
// a template without one of them simulates another case.
std::vector<std::string> StatedPlaceholders(const rigs::Case& rig_case);

// The placeholders by which a template takes a parameter that is searched between two cases: its
// own, or what follows from it, such as powder_pair_sliding_friction; of the bulk the grains, their
// number and lengths. A time step or a height of the box that follows from it tells a deck nothing.
std::vector<std::string> PlaceholdersOf(const std::string& parameter, const rigs::Case& low,
                                        const rigs::Case& high);

// The rows of `grains`: the powder as our own engine fills it into the tube for this seed. Takes a
// while for many grains, so only where a template asks for it.
void AddGrains(const rigs::Case& rig_case, TemplateValues& values);

}  // namespace talus::trials
