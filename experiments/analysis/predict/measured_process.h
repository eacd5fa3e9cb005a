// What was measured on the real process, for `talus predict --measured`.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "experiments/analysis/predict/predicted_case.h"
#include "experiments/campaign/spec/measured_numbers.h"
#include "imaging/heap/profile.h"

namespace talus::analysis {

struct MeasuredProcess {
  std::vector<campaign::ScalarSpec> numbers;
  std::optional<imaging::Profile> profile;
};

// From a JSON file with the keys of a spec's experiment (photographs or a map, numbers with their
// errors), or from a profile that `talus measure` wrote. Throws ConfigError where it has nothing,
// or a number that the rig does not give.
MeasuredProcess ReadMeasured(const std::filesystem::path& file, const PredictedCase& predicted);

}  // namespace talus::analysis
