// What remains between an experiment's image and the recommended set: a signed map in the
// campaign's folder.
#pragma once

#include <optional>
#include <string>

#include "base/field.h"

namespace talus::campaign {

struct ResultRemains {
  std::string experiment{};
  int picture = 1;                // of a film's, from 1
  std::string file{};             // in the campaign's folder
  int num_trials = 0;             // whose mean profile it is of; 0: as the model predicts it
  double sad_mm2 = 0;             // of that profile
  std::optional<double> share{};  // … over the powder's area in the picture, where it shows any

  TALUS_FIELDS(experiment, picture, file, num_trials, sad_mm2, share);
};

}  // namespace talus::campaign
