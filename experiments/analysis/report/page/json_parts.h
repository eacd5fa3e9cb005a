// The page's data as JSON, in parts. Numbers have six digits, which are more than a screen shows
// and keep a page of 10 000 trials small.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/analysis/compare/criterion.h"
#include "experiments/analysis/report/data/report_data.h"

namespace talus::analysis {

using PageValue = nlohmann::ordered_json;

PageValue NumberJson(double x);  // null where it is not finite
PageValue NumbersJson(const std::vector<double>& values);

template <class Range, class Function>
PageValue ListJson(const Range& range, Function&& make) {
  PageValue list = PageValue::array();
  for (const auto& element : range) list.push_back(make(element));
  return list;
}

// What a criterion's value is called, as its metric is not where it is a distance: "AOR 2, off by".
std::string ValueTitle(const Criterion& criterion);

// The picture stands in the page itself; null where there is none.
PageValue UriJson(const Picture& picture);

// What was searched, and by which trials; numbers in the units that people read.
PageValue CampaignJson(const ReportData& data);
PageValue ParametersJson(const Evidence& evidence);
PageValue MetricsJson(const Evidence& evidence);
PageValue TrialsJson(const Evidence& evidence);  // by column: half the size of a list of objects

// What the campaign concludes, and what to do next.
PageValue HeadlineJson(const ReportData& data);  // needs an answer
PageValue NextTableJson(const NextTableView& table);
PageValue PredictionJson(const PredictionView& view);
PageValue SensitivityJson(const SensitivityView& view);

}  // namespace talus::analysis
