// The report of a search by `talus optimize`: one HTML page that opens offline, its figures beside
// it.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/analysis/search/search_folder.h"

namespace talus::analysis {

std::string SearchPage(const SearchFolder& search);

// report.html, figures/*.svg and tables/evaluations.csv under `folder`, each written atomically.
// Returns the page's path.
std::filesystem::path WriteSearchReport(const SearchFolder& search,
                                        const std::filesystem::path& folder);

}  // namespace talus::analysis
