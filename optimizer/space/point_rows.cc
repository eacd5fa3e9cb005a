#include "optimizer/space/point_rows.h"

#include <algorithm>
#include <vector>

namespace talus::optimizer {

Eigen::MatrixXd Inside(const Domain& domain, const Eigen::MatrixXd& points) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (domain.Contains(points.row(i))) kept.push_back(i);
  }
  return points(kept, Eigen::all);
}

Eigen::MatrixXd Stack(const Eigen::MatrixXd& top, const Eigen::MatrixXd& bottom) {
  Eigen::MatrixXd both(top.rows() + bottom.rows(), bottom.cols());
  both << top, bottom;
  return both;
}

bool IsAmong(const Eigen::VectorXd& point, std::span<const Eigen::VectorXd> points) {
  return std::any_of(points.begin(), points.end(),
                     [&](const Eigen::VectorXd& other) { return SamePoint(point, other); });
}

}  // namespace talus::optimizer
