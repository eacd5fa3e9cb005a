// `talus next` for a campaign's folder, also at the end of a campaign: the table, kept as
// DIR/next/next.json, which the report shows.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/analysis/next/goal.h"
#include "experiments/analysis/next/next_table.h"

namespace talus::analysis {

struct AdviceRequest {
  std::filesystem::path candidates{};  // file of tests that could be made; empty: the usual ones
  bool simulate = false;               // designs, within the core time
  std::optional<double> core_time{};   // [s]; default: as much as the campaign has taken
  bool is_in_all = false;              // with what designs have taken before
  std::optional<GoalRequest> goal{};   // what is to be predicted; none: the parameters themselves
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

// Throws base::Error while there are too few trials for a posterior.
NextTable Advise(const std::filesystem::path& campaign, const AdviceRequest& request);

}  // namespace talus::analysis
