#include "optimizer/space/prior_spread.h"

#include <algorithm>
#include <cmath>

namespace talus::optimizer {

std::vector<double> PriorValues(const Domain& domain, Eigen::Index coordinate) {
  constexpr Eigen::Index kDraws = 2000;
  const Eigen::MatrixXd draws = domain.prior.Draw(kDraws, domain.num_parameters, 0);
  std::vector<double> values;
  for (const double u : draws.col(coordinate)) {
    if (u >= 0 && u <= 1) values.push_back(u);
  }
  if (values.size() < 2) return {0, 1};
  std::sort(values.begin(), values.end());
  return values;
}

double PriorSpread(const Domain& domain, Eigen::Index coordinate) {
  if (domain.prior.IsUniform()) return 1;
  const std::vector<double> values = PriorValues(domain, coordinate);
  const Eigen::Map<const Eigen::ArrayXd> u(values.data(), std::ssize(values));
  return std::min(1.0, std::sqrt(12 * (u - u.mean()).square().mean()));
}

double PriorSd(const Domain& domain, Eigen::Index coordinate) {
  return PriorSpread(domain, coordinate) / std::sqrt(12.0);
}

}  // namespace talus::optimizer
