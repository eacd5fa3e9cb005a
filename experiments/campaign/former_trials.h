// Simulations that lie finished in other folders: the trials of a campaign, and what `talus next`
// and `talus design` have simulated of tests before these were made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/campaign/folder/design_folder.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

struct FormerTrial {
  std::filesystem::path folder;
  std::vector<double> unit{};    // in the order of the test's parameters, as searched there
  std::vector<double> native{};  // SI
  std::int64_t seed = 0;
  double scale_factor = 1;
  double duration_s = 0;  // 0 where it is not known
  double cpu_s = 0;
};

// Those of one test.
struct FormerTest {
  std::string name;  // of the experiment, or of the design's folder
  std::vector<journal::ParameterRecord> parameters{};  // that are searched there
  std::vector<FormerTrial> trials{};
  int num_failed = 0;
};

// The simulations of a design, complete or not; without trials where it is damaged.
FormerTest FormerTestOf(const DesignFolder& design);

// The tests of a campaign with what has succeeded of them, then its designs; or the designs of a
// folder of `talus design`. Throws ConfigError where the folder is neither.
std::vector<FormerTest> FormerTestsIn(const std::filesystem::path& root);

}  // namespace talus::campaign
