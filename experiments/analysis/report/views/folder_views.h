// What lies in a campaign's folder beside the journal: the film of the test as the recommended set
// gives it, and what `talus sensitivity` and `talus predict` have found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/report/views/extras.h"
#include "experiments/analysis/sensitivity/sensitivity_table.h"

namespace talus::analysis {

struct FilmView {
  int trial = 0;
  std::string gif;  // of the file film.gif in its folder
};

// The film of the trial that confirms the recommended set; none without either, as of
// another engine's.
std::optional<FilmView> FilmOf(const Evidence& evidence);

struct SensitivityView {
  SensitivityTable table;
  bool is_outdated = false;  // trials have ended since
};

// Nothing where `talus sensitivity` has not been run. Throws ConfigError on a damaged file.
std::optional<SensitivityView> ReadSensitivity(const Evidence& evidence);

struct PredictionView {
  Prediction prediction;
  bool is_outdated = false;  // trials have ended since
  Picture mean;              // silhouette with its outlines; without a PNG where there is none
  Picture different;
};

// By the names of their folders; those by one set alone, too.
std::vector<PredictionView> ReadPredictions(const Evidence& evidence, LeftOut& left_out);

}  // namespace talus::analysis
