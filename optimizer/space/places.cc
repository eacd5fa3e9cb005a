#include "optimizer/space/places.h"

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

}  // namespace talus::optimizer
