// A further test of the same powder, given to a campaign that has begun or ended.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "experiments/campaign/folder/console.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::campaign {

struct AddOptions {
  // For the search with it [s], > 0; default: what it has used, or 16 simulations where it has not
  // ended.
  std::optional<double> core_time{};
  // The engine that the campaign simulates with; tests put another in its place.
  std::function<std::unique_ptr<trials::TrialEngine>()> engine{};
};

// Reads one entry of `experiments` from `file`, measures it and writes it into the campaign, whose
// search then has `core_time` more, on top of what is left of its budget where it has not ended.
// The trials there are stay, and what `talus next` has simulated of the same test is taken over;
// Resume simulates it where else it matters. Throws ConfigError, and changes nothing, where the
// campaign cannot have it.
void AddExperiment(const std::filesystem::path& folder, const std::filesystem::path& file,
                   const AddOptions& options, Console& console);

}  // namespace talus::campaign
