#include "experiments/campaign/answer/verdict.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace talus::campaign {
namespace {

// The draw nearest to the mean of those whose place along the direction is in [low, high].
Eigen::VectorXd MiddleOf(const Eigen::MatrixXd& points, const Eigen::VectorXd& place, double low,
                         double high) {
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(points.cols());
  double count = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (place[i] < low || place[i] > high) continue;
    mean += points.row(i);
    count += 1;
  }
  Eigen::Index nearest = 0;
  (points.rowwise() - mean / count).rowwise().squaredNorm().minCoeff(&nearest);
  return points.row(nearest);
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> TiedPair(
    const std::vector<std::vector<double>>& correlation, double least) {
  std::optional<std::pair<std::size_t, std::size_t>> pair;
  double most = least;
  for (std::size_t i = 0; i < correlation.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!(std::abs(correlation[i][j]) >= most)) continue;
      most = std::abs(correlation[i][j]);
      pair = {j, i};
    }
  }
  return pair;
}

std::vector<Eigen::VectorXd> RepresentativeSets(const Eigen::MatrixXd& points,
                                                const Eigen::VectorXd& recommended,
                                                const std::vector<Eigen::Index>& asked) {
  // Shares of the points between which each end is taken: beyond them is the posterior's tail.
  constexpr double kOuter = 0.04;
  constexpr double kInner = 0.12;
  if (points.rows() < 10) return {recommended};
  const Eigen::MatrixXd places = points(Eigen::all, asked);
  const Eigen::MatrixXd centred = places.rowwise() - places.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(centred.transpose() * centred);
  Eigen::VectorXd along = axes.eigenvectors().rightCols(1);
  Eigen::Index largest = 0;
  along.cwiseAbs().maxCoeff(&largest);
  if (along[largest] < 0) along = -along;
  const Eigen::VectorXd place = centred * along;
  std::vector<double> sorted(place.data(), place.data() + place.size());
  std::sort(sorted.begin(), sorted.end());
  const auto last = static_cast<double>(sorted.size() - 1);
  const auto at = [&](double share) { return sorted[static_cast<std::size_t>(share * last)]; };
  if (at(1 - kOuter) - at(kOuter) < kWideRange) return {recommended};
  return {MiddleOf(points, place, at(kOuter), at(kInner)), recommended,
          MiddleOf(points, place, at(1 - kInner), at(1 - kOuter))};
}

}  // namespace talus::campaign
