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

// From a JSON file with what a spec's experiment has measured (photographs or a map, a drum's, too;
// numbers with their errors), or from a profile that `talus measure` wrote. Throws ConfigError
// where it has nothing, a number that the rig does not give, or an image of another test.
MeasuredProcess ReadMeasured(const std::filesystem::path& file, const PredictedCase& predicted);

}  // namespace talus::analysis
