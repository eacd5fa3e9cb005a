// What a report shows of profiles: outlines, measures and pictures.
#pragma once

#include "experiments/analysis/report/data/report_data.h"

namespace talus::analysis {

// Fills the report's measures, outlines and pictures: the experiment's and those of the best set by
// each objective, each trial once.
void AddProfileViews(ReportData& data);

// The highest powder of each column, from foot to foot.
OutlineCurve MakeOutline(const std::string& title, const imaging::Profile& profile);

}  // namespace talus::analysis
