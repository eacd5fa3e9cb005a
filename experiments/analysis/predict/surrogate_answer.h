// Whether a number of a prediction is told by its draws or by a surrogate over them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "experiments/analysis/predict/prediction.h"
#include "experiments/analysis/predict/spread.h"
#include "optimizer/space/parameter_space.h"

namespace talus::analysis {

// Equally likely sets of the posterior, one point of the unit cube a row.
struct SetsOfPosterior {
  const optimizer::ParameterSpace& space;
  const Eigen::MatrixXd& points;
};

// Fits a surrogate to the number's runs and says how well it and the draws do on what they were not
// told; where the surrogate misses less, number and spread are by it, at the prediction's target
// scale factor. Nothing where too few draws have the number.
void AnswerBySurrogate(const Prediction& prediction, const SetsOfPosterior& sets,
                       PredictedNumber& number, std::optional<Spread>& spread);

// Mean, interval and where they come from.
void Take(const Spread& spread, PredictedNumber& number);

}  // namespace talus::analysis
