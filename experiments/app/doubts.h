// What a campaign's answer stands on, for the verbs that build on it.
#pragma once

#include <filesystem>

namespace talus::app {

// Says on the standard error stream why nothing should be built on the answer (campaign::IsDoubt);
// nothing where there is no such reason, or no answer yet.
void WarnOfDoubts(const std::filesystem::path& campaign);

}  // namespace talus::app
