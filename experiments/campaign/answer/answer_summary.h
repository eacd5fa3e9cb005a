// An answer on the terminal.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/campaign/answer/answer.h"

namespace talus::campaign {

// In some twenty lines; commands in it are for the campaign in `folder`.
std::string AnswerSummary(const Answer& answer, const std::filesystem::path& folder);

}  // namespace talus::campaign
