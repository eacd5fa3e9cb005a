#include "optimizer/posterior/branches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "optimizer/space/ascending.h"

namespace talus::optimizer {
namespace {

constexpr int kDrawsApart = 300;
constexpr double kReach = 0.35;       // between draws that are tried first, unit cube
constexpr int kTriesFar = 10;         // of two parts that are further apart
constexpr int kMostTries = 2000;      // of midpoints, each a density
constexpr double kLeastShare = 0.02;  // of the draws
constexpr double kRounding = 1e-9;    // of ln density, computed among other draws
constexpr double kDip = 1.0;  // in ln density: a dip by less is the surrogate's own unevenness

class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t Root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::size_t a, std::size_t b) { parent_[Root(a)] = Root(b); }

 private:
  std::vector<std::size_t> parent_;
};

struct Pair {
  double distance = 0;
  std::size_t a = 0;
  std::size_t b = 0;
};

// All, the nearest first. `places`: the draws' coordinates that are asked for.
std::vector<Pair> PairsByDistance(const Eigen::MatrixXd& places) {
  std::vector<Pair> pairs;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      pairs.push_back({.distance = (places.row(i) - places.row(j)).norm(),
                       .a = static_cast<std::size_t>(i),
                       .b = static_cast<std::size_t>(j)});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  return pairs;
}

// Whether the region holds a quarter, half and three quarters of the way.
bool IsJoined(const AskedDensity& posterior, const Eigen::MatrixXd& draws, const Pair& pair,
              double least) {
  Eigen::MatrixXd between(3, draws.cols());
  const Eigen::RowVectorXd a = draws.row(static_cast<Eigen::Index>(pair.a));
  const Eigen::RowVectorXd b = draws.row(static_cast<Eigen::Index>(pair.b));
  for (int i = 0; i < 3; ++i) between.row(i) = a + 0.25 * (i + 1) * (b - a);
  return posterior.LogDensity(between).minCoeff() > least - kDip;
}

// The draw of the densest quarter that is nearest to all others.
Eigen::Index MiddleOf(const Eigen::MatrixXd& places, const Eigen::VectorXd& density) {
  const std::vector<Eigen::Index> order = Ascending(density);
  const double dense = density[order[order.size() - (order.size() + 3) / 4]];
  Eigen::Index middle = 0;
  double least = -1;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    if (density[i] < dense) continue;
    const double sum = (places.rowwise() - places.row(i)).rowwise().norm().sum();
    if (least < 0 || sum < least) {
      least = sum;
      middle = i;
    }
  }
  return middle;
}

// The densest draw within a twelfth of the branch's size: across a thin valley it is on the ridge,
// where the middle of a bend lies inside; in a broad region hardly any draw is so near.
Eigen::Index RidgeBeside(Eigen::Index middle, const Eigen::MatrixXd& places,
                         const Eigen::VectorXd& density) {
  const Eigen::MatrixXd centred = places.rowwise() - places.colwise().mean();
  const double reach = std::sqrt(centred.rowwise().squaredNorm().mean()) / 12;
  Eigen::Index ridge = middle;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const double distance = (places.row(i) - places.row(middle)).norm();
    if (distance <= reach && density[i] > density[ridge]) ridge = i;
  }
  return ridge;
}

PosteriorBranch Describe(const Eigen::MatrixXd& members, const Eigen::MatrixXd& places,
                         const Eigen::VectorXd& density, Eigen::Index num_draws) {
  const Eigen::Index ridge = RidgeBeside(MiddleOf(places, density), places, density);
  return {.share = static_cast<double>(members.rows()) / static_cast<double>(num_draws),
          .point = members.row(ridge),
          .low = members.colwise().minCoeff(),
          .high = members.colwise().maxCoeff()};
}

// Draws that lie in the region; where none does, the densest.
struct Draws {
  Eigen::MatrixXd points;   // one a row
  Eigen::VectorXd density;  // its logarithm
};

Draws InsideRegion(const AskedDensity& posterior, const PosteriorSample& sample,
                   std::uint64_t seed) {
  const Eigen::MatrixXd draws = sample.Draws(kDrawsApart, seed);
  const Eigen::VectorXd density = posterior.LogDensity(draws);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if (density[i] >= sample.region_log_density - kRounding) inside.push_back(i);
  }
  if (inside.empty()) {
    inside.emplace_back();
    density.maxCoeff(&inside.front());
  }
  return {.points = draws(inside, Eigen::all), .density = density(inside)};
}

// Which of them the region joins, by ways that lie in it. With many parameters few draws have a
// neighbour within reach. What is left apart then is tried further, a pair of each two parts: a way
// that leaves the region between all others proves little.
Components JoinedWithin(double region_log_density, const AskedDensity& posterior,
                        const Draws& draws, const Eigen::MatrixXd& places) {
  Components components(static_cast<std::size_t>(draws.points.rows()));
  int tries = 0;
  std::map<std::pair<std::size_t, std::size_t>, int> tried;
  for (const Pair& pair : PairsByDistance(places)) {
    std::size_t a = components.Root(pair.a);
    std::size_t b = components.Root(pair.b);
    if (a == b) continue;
    if (a > b) std::swap(a, b);
    if (pair.distance >= kReach && ++tried[{a, b}] > kTriesFar) continue;
    if (++tries > kMostTries) break;
    if (IsJoined(posterior, draws.points, pair, region_log_density)) components.Join(a, b);
  }
  return components;
}

}  // namespace

std::vector<PosteriorBranch> FindBranches(const AskedDensity& posterior,
                                          const PosteriorSample& sample, std::uint64_t seed) {
  const Draws draws = InsideRegion(posterior, sample, seed);
  const Eigen::MatrixXd places = draws.points(Eigen::all, posterior.asked());
  Components components = JoinedWithin(sample.region_log_density, posterior, draws, places);
  std::map<std::size_t, std::vector<Eigen::Index>> members;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    members[components.Root(static_cast<std::size_t>(i))].push_back(i);
  }
  std::vector<PosteriorBranch> branches;
  const auto size = [](const auto& part) { return part.second.size(); };
  const std::size_t largest = size(*std::ranges::max_element(members, {}, size));
  for (const auto& part : members) {
    const std::vector<Eigen::Index>& rows = part.second;
    PosteriorBranch branch = Describe(draws.points(rows, Eigen::all), places(rows, Eigen::all),
                                      draws.density(rows), places.rows());
    if (branch.share < kLeastShare && size(part) < largest) continue;
    branch.point = posterior.WithTypicalNuisances(branch.point);
    branches.push_back(std::move(branch));
  }
  std::stable_sort(branches.begin(), branches.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  return branches;
}

}  // namespace talus::optimizer
