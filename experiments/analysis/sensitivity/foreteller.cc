#include "experiments/analysis/sensitivity/foreteller.h"

#include "optimizer/posterior/measured_response.h"

namespace talus::analysis {

void Foreteller::Tell(const SimulatedSet& more) {
  for (const std::vector<Simulated>& experiment : more) {
    for (const Simulated& one : experiment) strategy_->Tell(one.observation);
  }
  response_.resize(0, 0);
}

Foretold Foreteller::With(const std::vector<ShiftField>& shifts) {
  constexpr int kDraws = 1000;
  if (response_.size() == 0) {
    response_ =
        optimizer::ResponseToMeasured(posterior(), strategy_->Sample().Draws(kDraws, seed_));
  }
  std::vector<optimizer::ShiftBySet> more;
  Eigen::VectorXd variance(response_.cols());
  Eigen::Index left = 0;
  for (const ShiftField& shift : shifts) {
    more.emplace_back([&](const Eigen::MatrixXd& points) { return shift.At(points); });
    variance.segment(left, shift.variance().size()) = shift.variance();
    left += shift.variance().size();
  }
  return {.answer = strategy_->IfShifted(more),
          .standard_error = (response_.cwiseAbs2() * variance).cwiseSqrt()};
}

Foreteller ForetellerOf(const campaign::JointView& view) {
  return {campaign::AnsweringStrategy(view), view.spec.seed};
}

}  // namespace talus::analysis
