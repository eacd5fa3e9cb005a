#include "optimizer/posterior/rank_correlation.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace talus::optimizer {

Eigen::MatrixXd RankCorrelation(const Eigen::MatrixXd& sample) {
  Eigen::MatrixXd ranks(sample.rows(), sample.cols());
  std::vector<Eigen::Index> order(static_cast<std::size_t>(sample.rows()));
  for (Eigen::Index k = 0; k < sample.cols(); ++k) {
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return sample(a, k) < sample(b, k); });
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
      ranks(order[rank], k) = static_cast<double>(rank);
    }
  }
  const Eigen::MatrixXd centred = ranks.rowwise() - ranks.colwise().mean();
  const Eigen::MatrixXd covariance = centred.transpose() * centred;
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

}  // namespace talus::optimizer
