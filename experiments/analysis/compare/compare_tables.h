// What a comparison found, for a terminal, for other programs and for a paper.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/compare/compare.h"

namespace talus::analysis {

struct ComparedCampaign {
  const Evidence& evidence;
  const std::vector<ObjectiveFinding>& findings;
};

std::string ComparisonText(const ComparedCampaign& compared);
std::string ComparisonJson(const ComparedCampaign& compared);
std::string ObjectivesCsv(const ComparedCampaign& compared);  // a line an objective and source
std::string TenBestCsv(const ComparedCampaign& compared);

}  // namespace talus::analysis
