#include "optimizer/space/point_rows.h"

#include <algorithm>
#include <vector>

#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

// The candidates nearest to any of the points, each once, in the order of the list.
Eigen::MatrixXd NearestCandidates(const Domain& domain, const Eigen::MatrixXd& points) {
  std::vector<bool> chosen(static_cast<std::size_t>(domain.candidates.rows()));
  for (const auto& point : points.rowwise()) {
    Eigen::Index nearest = 0;
    (domain.candidates.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
    chosen[static_cast<std::size_t>(nearest)] = true;
  }
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i]) kept.push_back(static_cast<Eigen::Index>(i));
  }
  return domain.candidates(kept, Eigen::all);
}

}  // namespace

Eigen::MatrixXd Inside(const Domain& domain, const Eigen::MatrixXd& points) {
  if (domain.IsList()) return NearestCandidates(domain, points);
  std::vector<Eigen::Index> kept;
  Eigen::MatrixXd snapped = points;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (!domain.levels.empty()) snapped.row(i) = domain.Snap(points.row(i));
    if (domain.Contains(snapped.row(i))) kept.push_back(i);
  }
  return snapped(kept, Eigen::all);
}

Eigen::MatrixXd Stack(const Eigen::MatrixXd& top, const Eigen::MatrixXd& bottom) {
  Eigen::MatrixXd both(top.rows() + bottom.rows(), bottom.cols());
  both << top, bottom;
  return both;
}

bool IsAmong(const Eigen::VectorXd& point, std::span<const Eigen::VectorXd> points) {
  return std::any_of(points.begin(), points.end(), [&](const Eigen::VectorXd& other) {
    return surrogate::SamePoint(point, other);
  });
}

}  // namespace talus::optimizer
