#include "experiments/analysis/sensitivity/shift_field.h"

#include <utility>

namespace talus::analysis {

void ShiftField::Add(const Eigen::VectorXd& point, Shift shift) {
  points_.push_back(point);
  shifts_.push_back(std::move(shift));
}

Eigen::MatrixXd ShiftField::At(const Eigen::MatrixXd& points) const {
  constexpr double kSamePoint = 1e-9;  // squared distance that leaves the weights finite
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(points.rows(), shifts_.front().mean.size());
  Eigen::VectorXd total = Eigen::VectorXd::Zero(points.rows());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::VectorXd weight =
        ((points.rowwise() - points_[i].transpose()).rowwise().squaredNorm().array() + kSamePoint)
            .inverse();
    shift += weight * shifts_[i].mean.transpose();
    total += weight;
  }
  return total.cwiseInverse().asDiagonal() * shift;
}

}  // namespace talus::analysis
