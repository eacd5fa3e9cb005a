#include "optimizer/space/domain.h"

#include <algorithm>
#include <cmath>

#include "surrogate/same_point.h"

namespace talus::optimizer {

bool Domain::IsBeforeAdded(const Eigen::VectorXd& point) const {
  return std::any_of(added.begin(), added.end(), [&](const AddedCoordinate& a) {
    return std::abs(point[a.coordinate] - a.at) <= surrogate::kSamePoint;
  });
}

std::vector<Eigen::Index> Domain::Asked() const {
  std::vector<Eigen::Index> asked;
  for (Eigen::Index k = 0; k < num_parameters; ++k) {
    if (!std::binary_search(nuisances.begin(), nuisances.end(), k)) asked.push_back(k);
  }
  return asked;
}

Eigen::VectorXd Domain::Snap(const Eigen::VectorXd& point) const {
  if (IsList()) {
    Eigen::Index nearest = 0;
    (candidates.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    return candidates.row(nearest);
  }
  Eigen::VectorXd snapped = point;
  for (Eigen::Index k = 0; k < point.size(); ++k) {
    if (!HasLevels(k)) continue;
    const std::vector<double>& allowed = levels[static_cast<std::size_t>(k)];
    snapped[k] = *std::min_element(allowed.begin(), allowed.end(), [&](double a, double b) {
      return std::abs(a - point[k]) < std::abs(b - point[k]);
    });
  }
  return snapped;
}

}  // namespace talus::optimizer
