// Simulations of former campaigns and designs that a campaign was told first.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/field.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

struct ResultReused {
  std::string from{};     // the folder of the campaign, or of one test's design
  int num_trials = 0;     // that have been told
  double core_hours = 0;  // that they took there

  TALUS_FIELDS(from, num_trials, core_hours);
};

// By folder, in the order in which they were told. `num_cores`: of a trial.
std::vector<ResultReused> ReusedBy(std::span<const journal::TrialRecord> trials, int num_cores);

// "46 simulations of /data/heap_1 (0.07 core hours there)"
std::string ReusedText(const ResultReused& reused);
// A line each, as terminal and status show them.
std::string ReusedLines(const std::vector<ResultReused>& list);

}  // namespace talus::campaign
