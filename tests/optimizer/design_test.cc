#include "optimizer/designs/design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/random.h"
#include "optimizer/designs/points_within.h"
#include "optimizer/designs/posterior_design.h"

namespace talus::optimizer {
namespace design_test {

double SmallestDistance(const Points& points) {
  double smallest = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      smallest = std::min(smallest, (points[i] - points[j]).norm());
    }
  }
  return smallest;
}

TEST(FullFactorial, PublishedSweepHas576DistinctPointsThatReachTheCorners) {
  const std::vector<int> levels{8, 8, 9};
  const Points grid = FullFactorial(levels);
  EXPECT_EQ(grid.size(), 576u);
  // 1/8 is the smallest step, of the coordinate with nine levels; equal points have distance 0.
  EXPECT_NEAR(SmallestDistance(grid), 1.0 / 8, 1e-12);
  EXPECT_EQ(grid.front(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(grid.back(), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(grid[1], Eigen::Vector3d(0, 0, 0.125));  // the last coordinate runs fastest
}

TEST(HalfStepNeighbours, AreExactlyTheDistinctPointsInsideTheRange) {
  const std::vector<int> levels{8, 8, 9};
  const Eigen::Vector3d step(1.0 / 7, 1.0 / 7, 1.0 / 8);
  // A corner, its neighbour on an edge (they share neighbours), and one deep inside.
  const Points centers{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(step[0], 0, 0),
                       Eigen::Vector3d(3 * step[0], 4 * step[1], 4 * step[2])};
  std::set<std::vector<long>> expected;  // in half steps
  for (const Eigen::VectorXd& c : centers) {
    for (int code = 0; code < 27; ++code) {
      const int digit[] = {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
      std::vector<long> place;
      bool inside = code != 13;  // the centre itself
      for (int i = 0; i < 3; ++i) {
        const double x = c[i] + digit[i] * step[i] / 2;
        inside = inside && x > -1e-9 && x < 1 + 1e-9;
        place.push_back(std::lround(2 * x / step[i]));
      }
      if (inside) expected.insert(place);
    }
  }
  const Points found = HalfStepNeighbours(levels, centers);
  std::set<std::vector<long>> places;
  for (const Eigen::VectorXd& p : found) {
    places.insert({std::lround(2 * p[0] / step[0]), std::lround(2 * p[1] / step[1]),
                   std::lround(2 * p[2] / step[2])});
  }
  EXPECT_EQ(places, expected);
  EXPECT_EQ(found.size(), expected.size());
  // 7 of the corner, 11 of the edge, 26 inside; the first two share 4 of them.
  EXPECT_EQ(found.size(), 7u + 11u + 26u - 4u);
}

TEST(HalfStepNeighbours, ParameterWithOneLevelStaysInTheMiddle) {
  const std::vector<int> levels{1, 3};
  const Points found = HalfStepNeighbours(levels, FullFactorial(levels));
  ASSERT_EQ(found.size(), 2u);
  for (const Eigen::VectorXd& p : found) EXPECT_EQ(p[0], 0.5);
}

TEST(LatinHypercube, EachSliceOfEachCoordinateHoldsOnePoint) {
  for (const int n : {1, 2, 10, 37}) {
    for (const int d : {1, 3, 6}) {
      const Points points = LatinHypercube(n, d, 5);
      ASSERT_EQ(points.size(), static_cast<std::size_t>(n));
      for (int i = 0; i < d; ++i) {
        std::set<int> slices;
        for (const Eigen::VectorXd& p : points) slices.insert(static_cast<int>(p[i] * n));
        EXPECT_EQ(slices.size(), static_cast<std::size_t>(n));
        EXPECT_EQ(*slices.rbegin(), n - 1);
      }
    }
  }
}

TEST(LatinHypercube, KeepsItsPointsFurtherApartThanChanceForEverySeed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    // The best of 20 random designs of as many points is still no match.
    double random_best = 0;
    for (std::uint64_t k = 0; k < 20; ++k) {
      base::Random random(seed, base::Stream("test"), k);
      Points points(10, Eigen::VectorXd(3));
      for (auto& p : points) {
        for (auto& x : p) x = random.Uniform();
      }
      random_best = std::max(random_best, SmallestDistance(points));
    }
    EXPECT_GT(SmallestDistance(LatinHypercube(10, 3, seed)), random_best) << "seed " << seed;
  }
}

TEST(LatinHypercube, DependsOnTheSeedAlone) {
  EXPECT_EQ(LatinHypercube(10, 3, 1), LatinHypercube(10, 3, 1));
  EXPECT_NE(LatinHypercube(10, 3, 1), LatinHypercube(10, 3, 2));
}

TEST(Sobol, FirstPointsAreThePublishedOnes) {
  // Worked out by hand from the table's m: point 2 has m₂/4 = 3/4 or 1/4 (as 2 m₁ ⊕ m₁ = 3 for the
  // first polynomial), point 3 is point 2 ⊕ 1/2.
  const Points points = Sobol(4, 6, 0);
  EXPECT_EQ(points[0], Eigen::VectorXd::Zero(6));
  EXPECT_EQ(points[1], Eigen::VectorXd::Constant(6, 0.5));
  Eigen::VectorXd second(6);
  second << 0.75, 0.25, 0.25, 0.25, 0.75, 0.75;
  EXPECT_EQ(points[2], second);
  EXPECT_EQ(points[3], Eigen::VectorXd::Ones(6) - second);
}

// Whether each box of the partition into 2^a × 2^b boxes holds one of 2^(a+b) points.
bool OneInEachBox(const Points& points, int x, int y, int a, int b) {
  std::set<std::pair<int, int>> boxes;
  for (const Eigen::VectorXd& p : points) {
    boxes.insert({static_cast<int>(std::ldexp(p[x], a)), static_cast<int>(std::ldexp(p[y], b))});
  }
  return boxes.size() == points.size();
}

TEST(Sobol, FillsTheElementaryBoxesOfItsFirstTwoCoordinatesWithEverySeed) {
  for (const std::uint64_t seed : {0u, 1u, 99u}) {
    const Points points = Sobol(64, 6, seed);
    for (int a = 0; a <= 6; ++a) EXPECT_TRUE(OneInEachBox(points, 0, 1, a, 6 - a)) << a;
    // In one dimension every coordinate is a permutation of the 64 slices.
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(OneInEachBox(points, i, i, 6, 0)) << i;
  }
}

TEST(Sobol, IsSpreadMoreEvenlyThanChance) {
  // Mean of Π 2x is 1; its error over 256 points is 1/√256·√((4/3)⁶-1) ≈ 0.13 by chance.
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {  // unflipped, point 0 leans to the corner
    double sum = 0;
    for (const Eigen::VectorXd& p : Sobol(256, 6, seed)) sum += (2 * p).prod();
    EXPECT_NEAR(sum / 256, 1, 0.04);
  }
}

// Constraints that leave a fortieth of the cube: without them in mind, hardly a point of a Latin
// hypercube lies there.
TEST(PosteriorDesign, IsCompleteWithinNarrowConstraints) {
  Domain domain{.num_parameters = 2};
  domain.feasible = [](const Eigen::VectorXd& u) { return u[0] + u[1] < 0.22; };
  const int size = PosteriorDesignSize(domain);
  const Points points = PosteriorDesign(domain, size, 3);
  ASSERT_EQ(static_cast<int>(points.size()), size);
  for (const Eigen::VectorXd& point : points) EXPECT_TRUE(domain.Contains(point));
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(domain.Contains(SobolPoint(domain, i, 3)));
  EXPECT_GT(SmallestDistance(points), 0);
}

// A thousandth of the cube holds four of the first 4096 points.
TEST(PosteriorDesign, IsCompleteWhereConstraintsLeaveAThousandth) {
  Domain domain{.num_parameters = 3};
  domain.feasible = [](const Eigen::VectorXd& u) { return std::abs(u.sum() - 1) < 1e-3; };
  const int size = PosteriorDesignSize(domain);
  const Points points = PosteriorDesign(domain, size, 3);
  ASSERT_EQ(static_cast<int>(points.size()), size);
  EXPECT_GT(SmallestDistance(points), 0);
}

// One of nine points of a hypercube lay within, and a model was made of that and its repeat.
TEST(PointsWithin, AreAsManyWithinConstraintsAsWithout) {
  Domain domain{.num_parameters = 3};
  const Points hypercube = LatinHypercube(9, 3, 5);
  EXPECT_EQ(PointsWithin(domain, hypercube, 5), hypercube);
  domain.feasible = [](const Eigen::VectorXd& u) { return u.sum() <= 0.7; };
  const Points within = PointsWithin(domain, hypercube, 5);
  ASSERT_EQ(within.size(), 9u);
  for (const Eigen::VectorXd& point : within) EXPECT_TRUE(domain.Contains(point));
  EXPECT_GT(SmallestDistance(within), 0);
}

}  // namespace design_test
}  // namespace talus::optimizer
