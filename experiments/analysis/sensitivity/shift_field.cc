#include "experiments/analysis/sensitivity/shift_field.h"

#include <utility>

namespace talus::analysis {

void ShiftField::Add(const Eigen::VectorXd& point, Shift shift) {
  points_.push_back(point);
  shifts_.push_back(std::move(shift));
}

Eigen::MatrixXd ShiftField::At(const Eigen::MatrixXd& points) const {
  constexpr double kLeastSquare = 1e-9;  // of a distance, by which the weights stay finite
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(points.rows(), shifts_.front().mean.size());
  Eigen::VectorXd total = Eigen::VectorXd::Zero(points.rows());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::VectorXd weight =
        ((points.rowwise() - points_[i].transpose()).rowwise().squaredNorm().array() + kLeastSquare)
            .inverse();
    shift += weight * shifts_[i].mean.transpose();
    total += weight;
  }
  return total.cwiseInverse().asDiagonal() * shift;
}

}  // namespace talus::analysis
