// The report as one HTML page that opens offline: data, charting library and all are inside.
#pragma once

#include <string>

#include "experiments/analysis/report/report_data.h"

namespace talus::experiments {

std::string ReportPage(const ReportData& data);

// What the page's scripts draw from, as JSON.
std::string PageJson(const ReportData& data);

}  // namespace talus::experiments
