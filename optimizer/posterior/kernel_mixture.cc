#include "optimizer/posterior/kernel_mixture.h"

#include <cmath>

#include "base/normal.h"
#include "optimizer/posterior/posterior_sample.h"

namespace talus::optimizer {

KernelMixture::KernelMixture(const Eigen::MatrixXd& points, const Eigen::VectorXd& weight,
                             double width, base::Random& random) {
  const Eigen::RowVectorXd mean = weight.transpose() * points;
  const Eigen::MatrixXd centred = points.rowwise() - mean;
  Eigen::MatrixXd covariance = width * width * centred.transpose() * weight.asDiagonal() * centred;
  covariance.diagonal().array() += 1e-6;
  centres_ = points(Resample(weight, kCentres, random), Eigen::all);
  factor_.compute(covariance);
}

Eigen::MatrixXd KernelMixture::Draw(Eigen::Index count, base::Random& random) const {
  Eigen::MatrixXd points(count, centres_.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::VectorXd z(centres_.cols());
    for (double& one : z) one = random.Normal();
    points.row(i) = centres_.row(i % centres_.rows()) + (factor_.matrixL() * z).transpose();
  }
  return points;
}

Eigen::VectorXd KernelMixture::LogDensity(const Eigen::MatrixXd& points) const {
  const double log_root = Eigen::MatrixXd(factor_.matrixL()).diagonal().array().log().sum();
  const double constant = -log_root - base::kLogRootTwoPi * static_cast<double>(centres_.cols()) -
                          std::log(static_cast<double>(centres_.rows()));
  const Eigen::MatrixXd white = factor_.matrixL().solve(points.transpose());
  const Eigen::MatrixXd centres = factor_.matrixL().solve(centres_.transpose());
  Eigen::VectorXd density(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::VectorXd squared =
        (centres.colwise() - white.col(i)).colwise().squaredNorm().transpose();
    density[i] = constant + LogSumExp(-0.5 * squared);
  }
  return density;
}

}  // namespace talus::optimizer
