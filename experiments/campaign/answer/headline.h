// What an answer says first, in sentences: whether any set fits, what is not determined at all,
// what is and how well, and what kind of answer that makes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/answer/answer.h"

namespace talus::campaign {

// Nothing while there are too few trials for ranges.
std::optional<VerdictKind> VerdictKindOf(const Answer& answer);

// `names` is what the sentences call the parameters. Empty without a verdict.
std::vector<std::string> Headline(const Answer& answer, const std::vector<std::string>& names);

// The same with the names that specs have, in one text.
std::string HeadlineText(const Answer& answer);

}  // namespace talus::campaign
