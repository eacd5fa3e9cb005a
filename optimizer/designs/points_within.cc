#include "optimizer/designs/points_within.h"

#include <algorithm>
#include <iterator>

namespace talus::optimizer {

Points SobolInside(const Domain& domain, int num_points, std::uint64_t seed) {
  constexpr int kMostTried = 1 << 20;
  Points inside;
  for (int n = num_points; static_cast<int>(inside.size()) < num_points && n < kMostTried; n *= 2) {
    inside.clear();
    for (const Eigen::VectorXd& point : Sobol(n, domain.num_parameters, seed)) {
      if (domain.Contains(point)) inside.push_back(point);
      if (static_cast<int>(inside.size()) == num_points) break;
    }
  }
  return inside;
}

Eigen::VectorXd SobolPoint(const Domain& domain, int index, std::uint64_t seed) {
  const Points inside = SobolInside(domain, index + 1, seed);
  if (inside.empty()) return Sobol(index + 1, domain.num_parameters, seed).back();
  return inside[static_cast<std::size_t>(index) % inside.size()];
}

Points PointsWithin(const Domain& domain, const Points& points, std::uint64_t seed) {
  if (!domain.feasible || domain.IsList()) return points;
  Points within;
  std::ranges::copy_if(points, std::back_inserter(within),
                       [&](const Eigen::VectorXd& point) { return domain.Contains(point); });
  const auto num_missing = static_cast<int>(points.size() - within.size());
  if (num_missing == 0) return within;
  std::ranges::copy(SobolInside(domain, num_missing, seed), std::back_inserter(within));
  return within;
}

}  // namespace talus::optimizer
