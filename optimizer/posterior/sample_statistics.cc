#include "optimizer/posterior/sample_statistics.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "optimizer/space/ascending.h"
#include "optimizer/space/prior_spread.h"

namespace talus::optimizer {

Eigen::MatrixXd SortedColumns(Eigen::MatrixXd sample) {
  for (auto column : sample.colwise()) std::sort(column.begin(), column.end());
  return sample;
}

Eigen::MatrixXd RankCorrelation(const Eigen::MatrixXd& sample) {
  Eigen::MatrixXd ranks(sample.rows(), sample.cols());
  for (Eigen::Index k = 0; k < sample.cols(); ++k) {
    const std::vector<Eigen::Index> order = Ascending(sample.col(k));
    for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
      const auto is_equal = [&](Eigen::Index row) {
        return sample(row, k) == sample(order[first], k);
      };
      while (last < order.size() && is_equal(order[last])) ++last;
      const double shared = 0.5 * static_cast<double>(first + last - 1);  // by equal values
      for (std::size_t i = first; i < last; ++i) ranks(order[i], k) = shared;
    }
  }
  const Eigen::MatrixXd centred = ranks.rowwise() - ranks.colwise().mean();
  const Eigen::MatrixXd covariance = centred.transpose() * centred;
  // One value for all goes with nothing.
  const Eigen::VectorXd scale = covariance.diagonal().unaryExpr(
      [](double variance) { return variance > 0 ? 1 / std::sqrt(variance) : 0; });
  Eigen::MatrixXd correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  correlation.diagonal().setOnes();
  return correlation;
}

double Narrowing(const Eigen::MatrixXd& draws, Eigen::Index known, Eigen::Index other) {
  const Eigen::VectorXd y = draws.col(other).array() - draws.col(other).mean();
  const Eigen::VectorXd x = draws.col(known).array() - draws.col(known).mean();
  Eigen::MatrixXd terms(draws.rows(), 3);
  terms << Eigen::VectorXd::Ones(x.size()), x, x.cwiseAbs2();
  const Eigen::VectorXd left = y - terms * terms.colPivHouseholderQr().solve(y);
  const double all = y.squaredNorm();
  return all > 0 ? 1 - std::sqrt(std::min(1.0, left.squaredNorm() / all)) : 0;
}

double MovedParameters(const Domain& domain, const Eigen::MatrixXd& draws) {
  auto moved = static_cast<double>(domain.Asked().size());
  for (const Eigen::Index k : domain.nuisances) {
    const double sd = PriorSd(domain, k);
    const double variance = (draws.col(k).array() - draws.col(k).mean()).square().mean();
    moved += std::clamp(1 - variance / (sd * sd), 0.0, 1.0);
  }
  return moved;
}

}  // namespace talus::optimizer
