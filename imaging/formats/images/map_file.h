// A grey average map that someone already has: black = powder in every view, white = in none.
#pragma once

#include <filesystem>
#include <optional>

#include "imaging/heap/profile.h"

namespace talus::imaging {

// Without a frame the base is found: the lowest row with powder stands on it, and what is powder
// in at least 80 % of the views in that row spans the plate. Throws ConfigError that names the file
// and the remedy when the map is empty, black everywhere, or has no such base.
Profile ReadMap(const std::filesystem::path& path, double plate_diameter,
                const std::optional<Frame>& frame);

}  // namespace talus::imaging
