#include "optimizer/designs/posterior_design.h"

#include <cmath>
#include <vector>

#include "optimizer/space/prior_spread.h"

namespace talus::optimizer {
namespace {

constexpr double kOfNuisance = 0.5;  // of a parameter that is asked for

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
  for (const Eigen::Index k : domain.nuisances) parameters += kOfNuisance * PriorSpread(domain, k);
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
