// A case with its rig: what it costs, whether it can be simulated, and its file.
#pragma once

#include <filesystem>

#include "base/json/json_file.h"
#include "base/problems.h"
#include "experiments/rigs/case/case.h"

namespace talus::rigs {

// What the powder and the rig mean for the cost, before anything is simulated.
struct CaseSize : PowderSize {
  double filled_height = 0;   // of the dense filling [m]
  double simulated_time = 0;  // expected, of all phases [s]
  double grain_time = 0;      // of all grains, each while it is simulated [s]
};
CaseSize EstimateCase(const Case& rig_case);

// What no part of a case can see by itself, such as a tube that cannot hold the powder.
void ValidateCase(const Case& rig_case, base::Problems& problems);

// Fills in what follows from the rest: a size file's content, the mass of a drum's fill, the frame
// of a camera that has none.
void CompleteCase(Case& rig_case);

// The case that a file holds, complete and validated; throws as LoadCase does.
Case Completed(Case rig_case, const base::JsonFile& file);

// Reads, completes and validates a case; throws one ConfigError with everything that is wrong.
Case LoadCase(const std::filesystem::path& path);
Case LoadCase(const base::JsonFile& file);

}  // namespace talus::rigs
