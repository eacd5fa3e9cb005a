// The results of `talus measure` as JSON, CSV and text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "imaging/heap/metrics.h"
#include "imaging/photos/experiment.h"

namespace talus::trials {

// {"sad_mm2": {"value": …, "standard_error": …, "unit": …, "reference": …}, …}; what is not defined
// has "not_defined" with the reason in place of a value.
nlohmann::ordered_json MetricsJson(const std::vector<imaging::Metric>& metrics);

// The same, one metric a line.
std::string MetricsCsv(const std::vector<imaging::Metric>& metrics);

// "  repose_angle_2_mean_deg   25.0 ± 0.7"
std::string MetricsText(const std::vector<imaging::Metric>& metrics);

// Frame, metrics, noise floor, runs with their views, and what was left out.
nlohmann::ordered_json ExperimentJson(const imaging::Experiment& experiment);

// One line a photograph: plate, NEBP, angles.
std::string ViewsCsv(const imaging::Experiment& experiment);

}  // namespace talus::trials
