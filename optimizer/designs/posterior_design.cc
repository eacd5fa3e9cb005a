#include "optimizer/designs/posterior_design.h"

#include <cmath>
#include <vector>

#include "optimizer/designs/points_within.h"
#include "optimizer/space/point_rows.h"
#include "optimizer/space/prior_spread.h"

namespace talus::optimizer {
namespace {

constexpr double kOfNuisance = 0.5;  // of a parameter that is asked for
constexpr int kMostTried = 4096;     // points, where constraints leave little of the cube

void FollowPrior(const Domain& domain, Points& points) {
  if (domain.prior.IsUniform()) return;
  for (const Eigen::Index k : domain.nuisances) {
    const std::vector<double> values = PriorValues(domain, k);
    for (Eigen::VectorXd& point : points) {
      const auto at = static_cast<std::size_t>(point[k] * static_cast<double>(values.size()));
      point[k] = values[std::min(at, values.size() - 1)];
    }
  }
}

// Takes the points that are in the domain, until there are `size`.
void AppendThoseWithin(const Domain& domain, const Points& from, int size, Points& points) {
  for (const Eigen::VectorXd& point : from) {
    if (domain.Contains(point) && static_cast<int>(points.size()) < size) points.push_back(point);
  }
}

}  // namespace

int PosteriorDesignSize(const Domain& domain) {
  auto parameters = static_cast<double>(domain.Asked().size());
  for (const Eigen::Index k : domain.nuisances) parameters += kOfNuisance * PriorSpread(domain, k);
  return static_cast<int>(std::ceil(4 * parameters)) + 4;
}

int PosteriorDesignSize(const Domain& domain, int num_initial) {
  return num_initial > 0 ? num_initial : PosteriorDesignSize(domain);
}

Points PosteriorDesign(const Domain& domain, int size, std::uint64_t seed) {
  Points points = domain.guesses;
  Points hypercube = LatinHypercube(size, domain.num_parameters, seed);
  FollowPrior(domain, hypercube);
  AppendThoseWithin(domain, hypercube, size, points);
  // Constraints may have left few of them.
  if (domain.feasible && static_cast<int>(points.size()) < size) {
    Points more = Sobol(kMostTried, domain.num_parameters, seed);
    FollowPrior(domain, more);
    AppendThoseWithin(domain, more, size, points);
    if (static_cast<int>(points.size()) < size) {
      Points rest = SobolInside(domain, size, seed);
      std::erase_if(rest, [&](const Eigen::VectorXd& point) { return IsAmong(point, points); });
      AppendThoseWithin(domain, rest, size, points);
    }
  }
  return points;
}

}  // namespace talus::optimizer
