// Where a campaign stands, for people.
#pragma once

#include <filesystem>
#include <string>

namespace talus::experiments {

// Readable while it runs.
std::string StatusText(const std::filesystem::path& folder);

}  // namespace talus::experiments
