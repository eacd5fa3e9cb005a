// Where a given parameter set stands in what a campaign's trials say.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/answer/result_posterior.h"
#include "experiments/campaign/answer/result_prior.h"
#include "experiments/journal/records.h"
#include "optimizer/space/parameter_space.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::campaign {

struct NearTrial {
  journal::TrialRecord trial;
  double distance = 0;              // largest difference of a parameter, in its range's widths
  std::optional<double> objective;  // nothing where it failed or is not defined
};

// What is known of a parameter: beforehand, and from the trials.
struct ConsideredParameter {
  std::string name;
  std::string unit;
  std::optional<ResultPrior> prior;  // none: uniform
  bool is_nuisance = false;
  double low = 0;  // 90 % of the posterior, for all parameters asked for together
  double high = 0;
};

struct ConsideredSet {
  std::vector<journal::ParameterRecord> parameters;
  std::vector<double> values;  // in their order, SI; nuisances that are not given at their typical
                               // values
  std::vector<ConsideredParameter> known{};  // none while there are too few trials
  double target_scale_factor = 1;
  std::optional<double> credible_level;  // of the smallest joint region that holds it; nothing
                                         // while there are too few trials
  double surrogate_narrowing = 0;        // as ResultPosterior's
  std::vector<ResultStanding> experiments;
  std::vector<NearTrial> nearest;                  // the nearest first
  std::vector<journal::ExperimentRecord> records;  // of all experiments, in the campaign's order
  std::string objective_unit;
};

// A set as somebody gives it, of the free parameters in their order; NaN where one is not given.
struct GivenSet {
  Eigen::VectorXd point;       // of the unit cube
  std::vector<double> values;  // as given, SI
};

// Which parameters may be left out.
enum class MayLack { kNuisances, kAny };

// Values are text, "0.45" or "2 uJ/m^2". Throws ConfigError with every parameter that is missing,
// not known or outside its range.
GivenSet ReadSet(const optimizer::ParameterSpace& space,
                 const std::map<std::string, std::string>& set,
                 MayLack may_lack = MayLack::kNuisances);
// Its point, with the nuisances that were not given where they typically are beside the others.
Eigen::VectorXd Filled(const GivenSet& given, optimizer::PosteriorStrategy& strategy);

// The campaign may be running; nothing is written.
ConsideredSet ConsiderSet(const std::filesystem::path& folder,
                          const std::map<std::string, std::string>& set);

std::string ConsideredText(const ConsideredSet& considered);
std::string ConsideredJson(const ConsideredSet& considered);

}  // namespace talus::campaign
