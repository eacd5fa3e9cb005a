#include "optimizer/designs/posterior_design.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::optimizer {
namespace {

constexpr double kOfNuisance = 0.5;  // of a parameter that is asked for

// The prior's values of a coordinate inside the cube, ascending; two at least.
std::vector<double> PriorValues(const Domain& domain, Eigen::Index coordinate) {
  constexpr Eigen::Index kDraws = 2000;
  const Eigen::MatrixXd draws = domain.prior.Draw(kDraws, domain.num_parameters, 0);
  std::vector<double> values{0, 1};
  for (const double u : draws.col(coordinate)) {
    if (u >= 0 && u <= 1) values.push_back(u);
  }
  std::sort(values.begin(), values.end());
  return values;
}

// Over that of the uniform one.
double Spread(const Domain& domain, Eigen::Index coordinate) {
  if (domain.prior.IsUniform()) return 1;
  const std::vector<double> values = PriorValues(domain, coordinate);
  const Eigen::Map<const Eigen::ArrayXd> u(values.data(), std::ssize(values));
  return std::min(1.0, std::sqrt(12 * (u - u.mean()).square().mean()));
}

void FollowPrior(const Domain& domain, Points& points) {
  if (domain.prior.IsUniform()) return;
  for (const Eigen::Index k : domain.nuisances) {
    const std::vector<double> values = PriorValues(domain, k);
    for (Eigen::VectorXd& point : points) {
      point[k] = values[static_cast<std::size_t>(point[k] * static_cast<double>(values.size()))];
    }
  }
}

}  // namespace

int PosteriorDesignSize(const Domain& domain) {
  auto parameters = static_cast<double>(domain.Asked().size());
  for (const Eigen::Index k : domain.nuisances) parameters += kOfNuisance * Spread(domain, k);
  return static_cast<int>(std::ceil(4 * parameters)) + 4;
}

Points PosteriorDesign(const Domain& domain, int size, std::uint64_t seed) {
  Points points = domain.guesses;
  Points hypercube = LatinHypercube(size, domain.num_parameters, seed);
  FollowPrior(domain, hypercube);
  for (const Eigen::VectorXd& point : hypercube) {
    if (domain.Contains(point) && static_cast<int>(points.size()) < size) points.push_back(point);
  }
  return points;
}

}  // namespace talus::optimizer
