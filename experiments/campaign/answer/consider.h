// Where a given parameter set stands in what a campaign's trials say.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/answer/result_posterior.h"
#include "experiments/journal/records.h"
#include "optimizer/space/parameter_space.h"

namespace talus::campaign {

struct NearTrial {
  journal::TrialRecord trial;
  double distance = 0;              // largest difference of a parameter, in its range's widths
  std::optional<double> objective;  // nothing where it failed or is not defined
};

struct ConsideredSet {
  std::vector<journal::ParameterRecord> parameters;
  std::vector<double> values;  // in their order, SI
  double target_scale_factor = 1;
  std::optional<double> credible_level;  // of the smallest joint region that holds it; nothing
                                         // while there are too few trials
  std::vector<ResultStanding> experiments;
  std::vector<NearTrial> nearest;  // the nearest first
  std::string objective_unit;
};

// The point of the unit cube where each free parameter has the value given as text, "0.45" or
// "2 uJ/m^2"; throws ConfigError with every one that is missing, not known or outside its range.
Eigen::VectorXd ReadSet(const optimizer::ParameterSpace& space,
                        const std::map<std::string, std::string>& set);

// The campaign may be running; nothing is written.
ConsideredSet ConsiderSet(const std::filesystem::path& folder,
                          const std::map<std::string, std::string>& set);

std::string ConsideredText(const ConsideredSet& considered);
std::string ConsideredJson(const ConsideredSet& considered);

}  // namespace talus::campaign
