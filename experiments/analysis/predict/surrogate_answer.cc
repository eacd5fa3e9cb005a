#include "experiments/analysis/predict/surrogate_answer.h"

#include <cmath>

#include "base/not_known.h"
#include "experiments/analysis/predict/number_surrogate.h"

namespace talus::analysis {

void Take(const Spread& spread, PredictedNumber& number) {
  number.mean = spread.mean();
  const Range range = spread.Ninety();
  number.low = range.low;
  number.high = range.high;
  number.parameters_sd = spread.parameters_sd();
  number.run_sd = spread.run_sd();
  number.parameters_share = spread.ParametersShare();
}

void AnswerBySurrogate(const Prediction& prediction, const SetsOfPosterior& sets,
                       PredictedNumber& number, std::optional<Spread>& spread) {
  const auto surrogate = NumberSurrogate::Fit(prediction, number, sets.space);
  if (!surrogate || surrogate->draws_error() == 0) return;  // a number that never changes
  const Spread told(surrogate->At(sets.points), surrogate->run_sd(), rigs::BoundsOf(number.name));
  number.surrogate =
      PredictedSurrogate{.scale_factor = surrogate->scale_factor(),
                         .left_out_error = surrogate->left_out_error(),
                         .draws_error = surrogate->draws_error(),
                         .is_used = surrogate->left_out_error() < surrogate->draws_error(),
                         .sd = told.surrogate_sd()};
  if (!number.surrogate->is_used) return;
  const Eigen::VectorXd by_draw = surrogate->At(PointsOf(prediction, sets.space)).mean;
  number.by_draw.assign(by_draw.begin(), by_draw.end());
  const bool ran_twice = std::isfinite(number.run_sd);
  Take(told, number);
  // The surrogate's scatter of a run is then its prior's, not the process's.
  if (!ran_twice) number.run_sd = number.parameters_share = base::kNotKnown;
  spread = told;
}

}  // namespace talus::analysis
