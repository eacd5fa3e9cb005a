// The report's tables as CSV, SI units and those of the metrics in the heads.
#pragma once

#include <vector>

#include "experiments/analysis/report/data/report_data.h"

namespace talus::analysis {

// {name of the file without ending, content}: trials, objectives, ten_best, measures, outlines. Of
// the experiment that is shown; `others` have their own.
std::vector<NamedText> ReportTables(const ReportData& data);

}  // namespace talus::analysis
