// What `calibrate`, `resume` and `compare --objective` share: work on a campaign until its end.
#pragma once

#include <filesystem>

#include "experiments/campaign/start.h"

namespace talus::experiments {

// Prints the result. Throws base::Interrupted when the user ends it, base::Error without a result.
void GoOn(const std::filesystem::path& folder, const ResumeOptions& options);

}  // namespace talus::experiments
