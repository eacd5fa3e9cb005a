// For each objective: which sets it prefers, how far it can tell them apart, and so how unique its
// answer is. Once from the trials alone, once from a model of the measured quantity.
//
// Two sets tie when their objectives differ by no more than kTieMargin times the scatter of one
// evaluation, as in the optimiser's own answer. The tied region's volume is its share of the unit
// cube of the parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/not_known.h"
#include "experiments/analysis/compare/criterion.h"
#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/compare/objective_model.h"

namespace talus::analysis {

inline constexpr double kTieMargin = 1;
inline constexpr std::size_t kNumBest = 10;

// One set of parameters with all its trials: repeats count as one set with a better mean.
struct ComparedSet {
  std::vector<int> trials;     // ids
  Eigen::VectorXd point;       // unit cube
  std::vector<double> values;  // SI
  double quantity = 0;         // mean of the metric over the trials
  double objective = 0;        // of that mean
};

struct TrialFinding {
  std::size_t num_sets = 0;
  std::vector<ComparedSet> best;  // best first, at most kNumBest
  std::size_t num_tied = 0;       // sets that tie with the best, itself included
  double tied_volume = 0;         // of the points whose nearest set ties
};

struct ModelFinding {
  ObjectiveModel model;
  Eigen::VectorXd point;       // where the predicted objective is least, unit cube
  std::vector<double> values;  // SI
  ObjectivePrediction there;
  double tied_volume = 0;  // of the points whose prediction ties with that
  std::string withheld{};  // why the set says nothing; empty when it does
};

struct ObjectiveFinding {
  Criterion info;
  double reference = base::kNotKnown;        // the experiment's angle, or its number
  double reference_error = base::kNotKnown;  // its standard error
  double noise_sd = base::kNotKnown;         // scatter of one evaluation of the quantity
  std::string absent;  // why nothing can be said; empty when there is an answer
  TrialFinding from_trials;
  std::optional<ModelFinding> from_model;  // needs some more trials than none

  double margin() const { return noise_sd > 0 ? kTieMargin * noise_sd : 0; }
};

// Findings for CriteriaOf, in their order.
std::vector<ObjectiveFinding> CompareObjectives(const Evidence& evidence);

// The same without what the models call best. The scatter, and so what ties, is the same.
std::vector<ObjectiveFinding> CompareTrials(const Evidence& evidence);

}  // namespace talus::analysis
