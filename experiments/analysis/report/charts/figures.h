// The report's charts as SVG files.
#pragma once

#include <vector>

#include "experiments/analysis/report/report_data.h"

namespace talus::analysis {

// {name of the file without ending, content}: convergence, outlines, a slice a parameter, and for
// each pair of parameters the trials and the chance to tie.
std::vector<NamedText> ReportFigures(const ReportData& data);

}  // namespace talus::analysis
