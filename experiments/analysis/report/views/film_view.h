// The film of the test as the recommended set gives it.
#pragma once

#include <optional>
#include <string>

#include "experiments/analysis/compare/evidence.h"

namespace talus::analysis {

struct FilmView {
  int trial = 0;
  std::string gif;  // of the file film.gif in its folder
};

// The film of the trial that confirms the recommended set; none without either, as of
// another engine's.
std::optional<FilmView> FilmOf(const Evidence& evidence);

}  // namespace talus::analysis
