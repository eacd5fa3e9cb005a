#include "optimizer/search/best_observed.h"

namespace talus::optimizer {
namespace {

Eigen::VectorXd Somewhere(const Domain& domain) {
  if (!domain.guesses.empty()) return domain.guesses.front();
  return Eigen::VectorXd::Constant(domain.num_parameters, 0.5);
}

}  // namespace

Answer BestObserved(std::span<const Observation> told, const Domain& domain,
                    const std::string& how) {
  Answer answer;
  answer.credible.resize(static_cast<std::size_t>(domain.num_parameters));
  answer.correlation = Eigen::MatrixXd::Identity(domain.num_parameters, domain.num_parameters);
  answer.model = "no model: the best observation of " + how;
  const Observation* best = nullptr;
  for (const Observation& observation : told) {
    if (!observation.failed && (best == nullptr || observation.value < best->value)) {
      best = &observation;
    }
  }
  if (best == nullptr) {
    answer.point = Somewhere(domain);
    answer.is_guess = true;
    return answer;
  }
  answer.point = best->point;
  answer.predicted_value = best->value;
  for (Eigen::Index i = 0; i < answer.point.size(); ++i) {
    if (answer.point[i] > kSamePoint && answer.point[i] < 1 - kSamePoint) continue;
    answer.warnings.push_back(
        {.parameter = static_cast<int>(i), .is_upper = answer.point[i] > 0.5});
  }
  return answer;
}

}  // namespace talus::optimizer
