// The answer of a campaign as it stands.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/campaign/answer/answer.h"

namespace talus::campaign {

// By the journal: result.json may be from before the campaign went on. Nothing where it has none.
std::optional<Answer> StandingAnswer(const std::filesystem::path& campaign);

}  // namespace talus::campaign
