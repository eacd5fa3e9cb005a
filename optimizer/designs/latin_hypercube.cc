#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "optimizer/designs/design.h"

namespace talus::optimizer {
namespace {

// Column j is point j; every row is a permutation of 0 … n-1.
Eigen::MatrixXi RandomLatin(int num_points, int num_parameters, base::Random& random) {
  Eigen::MatrixXi cells(num_parameters, num_points);
  for (Eigen::Index i = 0; i < cells.rows(); ++i) {
    for (Eigen::Index j = 0; j < cells.cols(); ++j) {
      const auto k = static_cast<Eigen::Index>(random.Below(static_cast<std::uint64_t>(j) + 1));
      cells(i, j) = cells(i, k);
      cells(i, k) = static_cast<int>(j);
    }
  }
  return cells;
}

// Sum over the other points of distance^-10: dominated by the nearest one, yet smooth enough that
// every exchange that helps is seen [morris1995].
double Crowding(const Eigen::MatrixXi& cells, Eigen::Index j) {
  double sum = 0;
  for (Eigen::Index k = 0; k < cells.cols(); ++k) {
    if (k == j) continue;
    const double squared = (cells.col(k) - cells.col(j)).squaredNorm();
    sum += std::pow(squared, -5);
  }
  return sum;
}

}  // namespace

Points LatinHypercube(int num_points, int num_parameters, std::uint64_t seed) {
  base::Random random(seed, base::Stream("latin hypercube"));
  Eigen::MatrixXi cells = RandomLatin(num_points, num_parameters, random);
  // Enough for designs of some tens of points to settle; large ones are even without it, and each
  // exchange costs them a distance to every point: a second of these at most.
  constexpr int kMostDistances = 10000000;
  const int num_exchanges =
      num_points < 2 ? 0 : std::min({400 * num_points, 20000, kMostDistances / num_points});
  for (int e = 0; e < num_exchanges; ++e) {
    const auto n = static_cast<std::uint64_t>(num_points);
    const auto a = static_cast<Eigen::Index>(random.Below(n));
    const auto b =
        static_cast<Eigen::Index>((static_cast<std::uint64_t>(a) + 1 + random.Below(n - 1)) % n);
    const auto row =
        static_cast<Eigen::Index>(random.Below(static_cast<std::uint64_t>(num_parameters)));
    const double before = Crowding(cells, a) + Crowding(cells, b);
    std::swap(cells(row, a), cells(row, b));
    if (Crowding(cells, a) + Crowding(cells, b) > before) std::swap(cells(row, a), cells(row, b));
  }
  Points points;
  for (Eigen::Index j = 0; j < cells.cols(); ++j) {
    points.emplace_back((cells.col(j).cast<double>().array() + 0.5) / num_points);
  }
  return points;
}

}  // namespace talus::optimizer
