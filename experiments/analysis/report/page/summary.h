// The answer on one sheet of paper, to file or to hand on: photograph, simulated heap, region,
// table, conditions and alarms. One HTML file without scripts, which a browser prints as one page.
#pragma once

#include <string>

#include "experiments/analysis/report/data/report_data.h"

namespace talus::analysis {

// Empty before the campaign has an answer.
std::string SummaryPage(const ReportData& data);

}  // namespace talus::analysis
