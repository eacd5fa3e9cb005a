// What runs took, kept in their folder.
#pragma once

#include <filesystem>

namespace talus::campaign {

// Core time of all attempts at the case of a folder so far, however they have ended, or of runs of
// it that were removed [s]; 0 where none is kept.
double TimeTaken(const std::filesystem::path& folder);

void KeepTimeTaken(const std::filesystem::path& folder, double seconds);

}  // namespace talus::campaign
