#include "optimizer/posterior/expected_narrowing.h"

#include <cmath>

#include "optimizer/posterior/credible_ranges.h"
#include "optimizer/posterior/posterior_sample.h"

namespace talus::optimizer {
namespace {

constexpr int kFantasies = 8;  // draws of g

}  // namespace

Eigen::VectorXd ExpectedNarrowing(const Posterior& posterior, const Eigen::MatrixXd& draws,
                                  const std::vector<Eigen::Index>& asked,
                                  const std::vector<SurrogateAhead>& ahead, std::uint64_t seed) {
  const std::vector<OutputMoments> outputs = posterior.Outputs(draws);
  const Eigen::VectorXd log_density = posterior.LogDensity(outputs);
  Posterior then = posterior;
  std::vector<std::vector<Eigen::MatrixXd>> moves(outputs.size());  // g, [experiment][output]
  for (std::size_t e = 0; e < outputs.size(); ++e) {
    if (outputs[e].variance.rows() == 0) continue;  // held out
    then.models()[e].TakeForFinest(ahead[e].times_finest);
    moves[e] = posterior.models()[e].ErrorDraws(draws, kFantasies, seed + e);
  }
  const Eigen::MatrixXd now = draws(Eigen::all, asked);
  Eigen::ArrayXd width_then = Eigen::ArrayXd::Zero(now.cols());
  for (int f = 0; f < kFantasies; ++f) {
    std::vector<OutputMoments> fantasy = outputs;
    for (std::size_t e = 0; e < fantasy.size(); ++e) {
      for (std::size_t k = 0; k < moves[e].size(); ++k) {
        const auto output = static_cast<Eigen::Index>(k);
        const double left = ahead[e].left[output];
        const double moved = std::sqrt(1 - left);
        fantasy[e].mean.col(output) += moved * moves[e][k].row(f).transpose();
        fantasy[e].variance.col(output) *= left;
      }
    }
    const Eigen::VectorXd log_weight = then.LogDensity(fantasy) - log_density;
    const Eigen::VectorXd weight = (log_weight.array() - log_weight.maxCoeff()).exp();
    width_then += CredibleWidths90(Resampled(now, weight)).array() / kFantasies;
  }
  return (1 - width_then / CredibleWidths90(now).array().max(1e-12)).max(0.0);
}

}  // namespace talus::optimizer
