// The report as one HTML page that opens offline: data, charting library and all are inside.
#pragma once

#include <string>

#include "experiments/analysis/report/data/report_data.h"

namespace talus::analysis {

struct PageOptions {
  int reload =
      0;  // while the campaign runs the page loads itself again after so long [s]; 0: never
};

std::string ReportPage(const ReportData& data, const PageOptions& options = {});

// What the page's scripts draw from, as JSON.
std::string PageJson(const ReportData& data);

}  // namespace talus::analysis
