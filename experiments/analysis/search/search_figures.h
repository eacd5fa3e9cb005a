// The charts of a search by `talus optimize`.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/search/search_folder.h"

namespace talus::analysis {

struct SearchFigure {
  std::string name;     // of the file, without ending
  std::string caption;  // plain text
  std::string svg;
};

// Convergence, and for each parameter the values against it with its credible range. None while no
// evaluation has succeeded.
std::vector<SearchFigure> SearchFigures(const SearchFolder& search);

// The evaluation of the lowest value; null while none has succeeded.
const SearchEvaluation* BestOf(const SearchFolder& search);

}  // namespace talus::analysis
