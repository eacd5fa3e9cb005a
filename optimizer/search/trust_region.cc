#include "optimizer/search/trust_region.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "optimizer/search/neighbours.h"
#include "surrogate/nlopt_minimize.h"

namespace talus::optimizer {
namespace {

// value ≈ g·s + ½ sᵀ H s above the centre's value, s = (x - centre) / radius.
struct Quadratic {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;

  double At(const Eigen::VectorXd& s, Eigen::VectorXd* slope) const {
    const Eigen::VectorXd curvature = hessian * s;
    if (slope != nullptr) *slope = gradient + curvature;
    return gradient.dot(s) + 0.5 * s.dot(curvature);
  }
};

// Weighted least squares with a slight preference for a small Hessian, which decides what too few
// or badly placed neighbours leave open.
Quadratic Fit(const History& history, const Neighbours& near, double radius) {
  constexpr double kRidge = 1e-4;
  const auto dimension = history.points.cols();
  const auto num_terms = dimension + dimension * (dimension + 1) / 2;
  const auto rows = static_cast<Eigen::Index>(near.others.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows + num_terms - dimension, num_terms);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(a.rows());
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Eigen::Index i = near.others[static_cast<std::size_t>(r)];
    const Eigen::VectorXd s = (history.points.row(i) - near.middle.transpose()) / radius;
    const double weight = 1 / (0.05 + std::pow(s.squaredNorm(), 1.5));
    a.row(r).head(dimension) = weight * s;
    Eigen::Index column = dimension;
    for (Eigen::Index j = 0; j < dimension; ++j) {
      for (Eigen::Index k = j; k < dimension; ++k) {
        a(r, column++) = weight * s[j] * s[k] * (j == k ? 0.5 : 1.0);
      }
    }
    b[r] = weight * (history.values[i] - history.values[near.best]);
  }
  for (Eigen::Index k = dimension; k < num_terms; ++k) a(rows + k - dimension, k) = kRidge;
  const Eigen::VectorXd terms = a.completeOrthogonalDecomposition().solve(b);
  Quadratic model{terms.head(dimension), Eigen::MatrixXd(dimension, dimension)};
  Eigen::Index column = dimension;
  for (Eigen::Index j = 0; j < dimension; ++j) {
    for (Eigen::Index k = j; k < dimension; ++k) {
      model.hessian(j, k) = model.hessian(k, j) = terms[column++];
    }
  }
  return model;
}

}  // namespace

std::optional<Eigen::VectorXd> TrustRegionStep(const History& history, const Domain& domain) {
  const auto dimension = static_cast<int>(history.points.cols());
  const int num_terms = dimension + dimension * (dimension + 1) / 2;
  const Neighbours near = NeighboursOfBest(history, num_terms + dimension + 2);
  if (static_cast<int>(near.others.size()) < dimension + 1) return std::nullopt;
  const double radius = near.DistanceOf(num_terms);
  const Quadratic model = Fit(history, near, radius);
  const double reach = std::min(1.0, near.DistanceOf(2 * dimension) / radius);
  // The box of the region, within the cube.
  surrogate::SearchTask task{.algorithm = surrogate::SearchAlgorithm::kLbfgs,
                             .lower = (-near.middle / radius).cwiseMax(-reach),
                             .upper = ((1 - near.middle.array()).matrix() / radius).cwiseMin(reach),
                             .max_evaluations = 100,
                             .absolute_tolerance = 1e-9};
  Eigen::VectorXd best = Eigen::VectorXd::Zero(dimension);
  double lowest = 0;
  for (int corner = 0; corner <= (1 << dimension); ++corner) {
    task.start = Eigen::VectorXd::Zero(dimension);
    for (int k = 0; k < dimension && corner > 0; ++k) {
      task.start[k] = ((corner - 1) >> k & 1) != 0 ? task.upper[k] : task.lower[k];
    }
    const surrogate::Minimum found = surrogate::Minimize(
        [&](const Eigen::VectorXd& s, Eigen::VectorXd* slope) { return model.At(s, slope); }, task);
    if (found.value < lowest) {
      lowest = found.value;
      best = found.point;
    }
  }
  const Eigen::VectorXd point = (near.middle + radius * best).cwiseMax(0.0).cwiseMin(1.0);
  if (!(best.norm() > 1e-4) || !domain.Contains(point)) return std::nullopt;
  return point;
}

}  // namespace talus::optimizer
