// The journal's tables of experiments: what was measured on the real powder.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/journal/database.h"
#include "experiments/journal/records.h"

namespace talus::journal {

void InsertExperiment(Database& database, std::int64_t position,
                      const ExperimentRecord& experiment);

// In their order, with their images.
std::vector<ExperimentRecord> ReadExperiments(Database& database);

}  // namespace talus::journal
