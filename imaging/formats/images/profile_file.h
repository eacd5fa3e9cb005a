// A profile in files: NAME.png, 8-bit grey, and NAME.json beside it with the frame.
#pragma once

#include <filesystem>

#include "imaging/heap/profile.h"

namespace talus::imaging {

// Writes `png` and, with the extension .json, {"frame": {…}}.
void WriteProfile(const std::filesystem::path& png, const Profile& profile);

// What WriteProfile wrote, or the aehp.png in a folder. Throws ConfigError that says what is
// missing.
Profile ReadProfile(const std::filesystem::path& path);

// The frame in such a JSON file.
Frame ReadFrame(const std::filesystem::path& json);

}  // namespace talus::imaging
