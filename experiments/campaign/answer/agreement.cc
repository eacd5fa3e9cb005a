#include "experiments/campaign/answer/agreement.h"

#include <algorithm>
#include <cmath>

#include "base/not_known.h"
#include "experiments/campaign/answer/hold_out.h"
#include "optimizer/posterior/sample_statistics.h"

namespace talus::campaign {
namespace {

constexpr int kDraws = 400;  // among which a least misfit is looked for

}  // namespace

double Tension(double chi_squared, double freedom) {
  // A nuisance counts by share. Of less than that the cube root's normal is none any more: a pull
  // of 0 would score 3 of 0.02 degrees.
  constexpr double kFewestDegrees = 0.5;
  if (freedom < kFewestDegrees) return base::kNotKnown;
  const double variance = 2 / (9 * freedom);
  const double root = std::cbrt(std::max(0.0, chi_squared) / freedom);
  return std::max(0.0, (root - (1 - variance)) / std::sqrt(variance));
}

Agreement AgreementOf(const JointView& view) {
  const std::vector<int> experiments = view.Answered();
  // One experiment pulls against none; beside one that is held out, it still has an answer to list.
  if (experiments.size() < 2) return {.alone = AnswersAlone(view)};
  const auto joint = StrategyOf(view, experiments);
  if (!joint->CanModel()) return {};
  Agreement agreement;
  const optimizer::Posterior& posterior = joint->Model();
  const Eigen::MatrixXd draws = joint->Sample().Draws(kDraws, view.spec.seed);
  Eigen::MatrixXd misfit(draws.rows(), static_cast<Eigen::Index>(experiments.size()));
  for (std::size_t k = 0; k < experiments.size(); ++k) {
    misfit.col(static_cast<Eigen::Index>(k)) = posterior.SquaredMisfit(k, draws);
  }
  Eigen::Index best = 0;
  misfit.rowwise().sum().minCoeff(&best);
  const double moved = optimizer::MovedParameters(view.space.MakeDomain(), draws);
  double freedom = -moved;
  double sum = 0;
  double most = 0;
  for (std::size_t k = 0; k < experiments.size(); ++k) {
    const auto alone = StrategyOf(view, {experiments[k]});
    agreement.alone.push_back(AnswerOf(view, *alone, {experiments[k]}));
    const double least =
        posterior.SquaredMisfit(k, alone->Sample().Draws(kDraws, view.spec.seed)).minCoeff();
    freedom += std::min(moved, static_cast<double>(posterior.models()[k].num_outputs()));
    const double pull = misfit(best, static_cast<Eigen::Index>(k)) - least;
    sum += pull;
    if (pull <= most) continue;
    most = pull;
    agreement.odd = agreement.alone.back().experiments.front();
  }
  agreement.tension = Tension(sum, freedom);
  if (!(agreement.tension > 0)) agreement.odd.clear();
  return agreement;
}

bool Disagree(double tension, double raw_coverage) {
  constexpr double kTolerated = 2;  // standard deviations: by chance one in 44
  constexpr double kLeastCoverage = 0.5;
  return tension > kTolerated && raw_coverage >= kLeastCoverage;
}

}  // namespace talus::campaign
