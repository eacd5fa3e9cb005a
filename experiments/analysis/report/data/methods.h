// A paragraph for a paper's methods section, with the campaign's own numbers in it.
#pragma once

#include <string>

#include "experiments/analysis/report/data/report_data.h"

namespace talus::analysis {

// Says only what the journal knows; ends before the result where there is none yet.
std::string MethodsText(const ReportData& data);

}  // namespace talus::analysis
