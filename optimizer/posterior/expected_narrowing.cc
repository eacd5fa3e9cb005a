#include "optimizer/posterior/expected_narrowing.h"

#include <cmath>

#include "optimizer/posterior/credible_ranges.h"
#include "optimizer/posterior/posterior_sample.h"

namespace talus::optimizer {
namespace {

constexpr int kFantasies = 8;  // draws of g

}  // namespace

ExpectedNarrowing::ExpectedNarrowing(const Posterior& posterior, const Eigen::MatrixXd& draws,
                                     std::uint64_t seed)
    : posterior_(posterior),
      draws_(draws),
      outputs_(posterior.Outputs(draws)),
      log_density_(posterior.LogDensity(outputs_)),
      moves_(outputs_.size()) {
  for (std::size_t e = 0; e < outputs_.size(); ++e) {
    if (outputs_[e].variance.rows() == 0) continue;
    moves_[e] = posterior.models()[e].ErrorDraws(draws, kFantasies, seed + e);
  }
}

std::vector<OutputMoments> ExpectedNarrowing::Fantasy(
    int f, const std::vector<SurrogateAhead>& ahead) const {
  std::vector<OutputMoments> fantasy = outputs_;
  for (std::size_t e = 0; e < fantasy.size(); ++e) {
    for (std::size_t k = 0; k < moves_[e].size(); ++k) {
      const auto output = static_cast<Eigen::Index>(k);
      const double left = ahead[e].left[output];
      const double moved = std::sqrt(1 - left);
      fantasy[e].mean.col(output) += moved * moves_[e][k].row(f).transpose();
      fantasy[e].variance.col(output) *= left;
    }
  }
  return fantasy;
}

Eigen::VectorXd ExpectedNarrowing::Of(const std::vector<Eigen::Index>& asked,
                                      const std::vector<SurrogateAhead>& ahead) const {
  Posterior then = posterior_;
  for (std::size_t e = 0; e < outputs_.size(); ++e) {
    if (outputs_[e].variance.rows() > 0) then.models()[e].TakeForFinest(ahead[e].times_finest);
  }
  const Eigen::MatrixXd now = draws_(Eigen::all, asked);
  Eigen::ArrayXd width_then = Eigen::ArrayXd::Zero(now.cols());
  for (int f = 0; f < kFantasies; ++f) {
    const Eigen::VectorXd log_weight = then.LogDensity(Fantasy(f, ahead)) - log_density_;
    const Eigen::VectorXd weight = (log_weight.array() - log_weight.maxCoeff()).exp();
    width_then += CredibleWidths90(Resampled(now, weight)).array() / kFantasies;
  }
  return (1 - width_then / CredibleWidths90(now).array().max(1e-12)).max(0.0);
}

}  // namespace talus::optimizer
