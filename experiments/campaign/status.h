// Where a campaign stands, for people.
#pragma once

#include <filesystem>
#include <string>

namespace talus::campaign {

// Readable while it runs.
std::string StatusText(const std::filesystem::path& folder);

}  // namespace talus::campaign
