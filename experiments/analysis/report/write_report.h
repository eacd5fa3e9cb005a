// The report of a campaign as files.
#pragma once

#include <filesystem>

#include "experiments/analysis/report/data/report_data.h"
#include "experiments/analysis/report/page/page.h"

namespace talus::analysis {

// report.html, summary.html once there is an answer, figures/*.png and tables/*.csv (those of
// further experiments in folders of their names) under `folder`, each written atomically.
// Returns the page's path.
std::filesystem::path WriteReport(const ReportData& data, const std::filesystem::path& folder,
                                  const PageOptions& page = {});

}  // namespace talus::analysis
