#include "optimizer/posterior/moved_parameters.h"

#include <algorithm>

#include "optimizer/space/prior_spread.h"

namespace talus::optimizer {

double MovedParameters(const Domain& domain, const Eigen::MatrixXd& draws) {
  auto moved = static_cast<double>(domain.Asked().size());
  for (const Eigen::Index k : domain.nuisances) {
    const double sd = PriorSd(domain, k);
    const double variance = (draws.col(k).array() - draws.col(k).mean()).square().mean();
    moved += std::clamp(1 - variance / (sd * sd), 0.0, 1.0);
  }
  return moved;
}

}  // namespace talus::optimizer
