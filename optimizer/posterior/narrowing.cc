#include "optimizer/posterior/narrowing.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace talus::optimizer {

double Narrowing(const Eigen::MatrixXd& draws, Eigen::Index known, Eigen::Index other) {
  const Eigen::VectorXd y = draws.col(other).array() - draws.col(other).mean();
  const Eigen::VectorXd x = draws.col(known).array() - draws.col(known).mean();
  Eigen::MatrixXd terms(draws.rows(), 3);
  terms << Eigen::VectorXd::Ones(x.size()), x, x.cwiseAbs2();
  const Eigen::VectorXd left = y - terms * terms.colPivHouseholderQr().solve(y);
  const double all = y.squaredNorm();
  return all > 0 ? 1 - std::sqrt(std::min(1.0, left.squaredNorm() / all)) : 0;
}

}  // namespace talus::optimizer
