// A further test of the same powder, given to a campaign that has begun or ended.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/campaign/folder/console.h"

namespace talus::campaign {

struct AddOptions {
  std::optional<double> core_time{};  // for the search with it [s], > 0; default: what it has used
};

// Reads one entry of `experiments` from `file`, measures it and writes it into the campaign, whose
// search then has `core_time` more. The trials there are stay; Resume simulates the new test where
// it matters. Throws ConfigError, and changes nothing, where the campaign cannot have it.
void AddExperiment(const std::filesystem::path& folder, const std::filesystem::path& file,
                   const AddOptions& options, Console& console);

}  // namespace talus::campaign
