#include "experiments/analysis/sensitivity/stated_answer.h"

#include <algorithm>

namespace talus::analysis {

StatedAnswer StatedAnswerOf(const optimizer::ParameterSpace& space,
                            const optimizer::Answer& answer) {
  StatedAnswer stated{
      .space = space, .point = answer.point, .half_ranges = Eigen::VectorXd(answer.point.size())};
  for (Eigen::Index k = 0; k < stated.half_ranges.size(); ++k) {
    const optimizer::Range& range = answer.credible[static_cast<std::size_t>(k)];
    stated.half_ranges[k] = (range.high - range.low) / 2;
  }
  return stated;
}

void StatedAnswer::Compare(const Foretold& foretold, FixedMove& move) const {
  const optimizer::AnswerIfShifted& found = foretold.answer;
  const Eigen::VectorXd& error = foretold.standard_error;
  const std::vector<int> free = space.Free();
  move.implausibility = found.implausibility;
  move.answer.clear();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const optimizer::Parameter& p = space.parameters[static_cast<std::size_t>(free[i])];
    const double below = std::max(0.0, found.point[k] - error[k]);
    const double above = std::min(1.0, found.point[k] + error[k]);
    // At an end of the range one side is cut off.
    const double shown = above > below ? error[k] / (above - below) : 0;
    move.answer.push_back({.parameter = p.name,
                           .from = p.ToNative(point[k]),
                           .to = p.ToNative(found.point[k]),
                           .standard_error = shown * (p.ToNative(above) - p.ToNative(below)),
                           .low = p.ToNative(found.credible[i].low),
                           .high = p.ToNative(found.credible[i].high),
                           .half_ranges = (found.point[k] - point[k]) / half_ranges[k],
                           .half_ranges_error = error[k] / half_ranges[k]});
  }
}

Eigen::VectorXd StatedAnswer::Shifted(const std::vector<AnswerShift>& shifts) const {
  Eigen::VectorXd shifted = point;
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    shifted[k] += half_ranges[k] * shifts[i].half_ranges;
  }
  return shifted;
}

}  // namespace talus::analysis
