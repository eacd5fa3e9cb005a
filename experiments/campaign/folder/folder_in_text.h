// Texts of a result name commands of a campaign, "`talus resume DIR`". The result keeps them so,
// since a campaign's folder may be moved; whoever shows them names the folder.
#pragma once

#include <filesystem>
#include <string>

namespace talus::campaign {

// Each "talus VERB DIR" with the folder in place of DIR, quoted for a shell where it needs it.
std::string WithFolder(const std::string& text, const std::filesystem::path& folder);

}  // namespace talus::campaign
