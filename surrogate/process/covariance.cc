#include "surrogate/process/covariance.h"

#include <utility>

#include "base/parallel_for.h"

namespace talus::surrogate {

Covariance::Covariance(Kernel kernel, Hyperparameters hyper)
    : kernel_(kernel), hyper_(std::move(hyper)), inverse_length_(hyper_.length.cwiseInverse()) {}

double Covariance::At(const double* a, const double* b) const {
  double q = 0;
  double p = 0;
  for (Eigen::Index k = 0; k < inverse_length_.size(); ++k) {
    const double step = (a[k] - b[k]) * inverse_length_[k];
    q += step * step;
    p += (2 * a[k] - 1) * (2 * b[k] - 1);
  }
  return kConstantSd * kConstantSd + hyper_.trend * hyper_.trend * (p + p * p) +
         hyper_.signal * hyper_.signal * CorrelationAt(kernel_, q).value;
}

Eigen::MatrixXd Covariance::Between(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const {
  Eigen::MatrixXd result(a.cols(), b.cols());
  constexpr double kPairWork = 40;
  base::ParallelFor({.num_items = b.cols(), .item_work = kPairWork * static_cast<double>(a.cols())},
                    [&](Eigen::Index j) {
                      for (Eigen::Index i = 0; i < a.cols(); ++i) {
                        result(i, j) = At(a.col(i).data(), b.col(j).data());
                      }
                    });
  return result;
}

Eigen::VectorXd Covariance::Diagonal(const Eigen::MatrixXd& points) const {
  Eigen::VectorXd result(points.cols());
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    result[j] = At(points.col(j).data(), points.col(j).data());
  }
  return result;
}

Eigen::MatrixXd Covariance::Gradient(const Eigen::VectorXd& x, const Eigen::MatrixXd& b) const {
  const double signal2 = hyper_.signal * hyper_.signal;
  const double trend2 = hyper_.trend * hyper_.trend;
  const Eigen::VectorXd z = 2 * x.array() - 1;
  Eigen::MatrixXd result(x.size(), b.cols());
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    const Eigen::VectorXd step = (x - b.col(j)).cwiseProduct(inverse_length_);
    const Eigen::VectorXd other = 2 * b.col(j).array() - 1;
    const double slope = CorrelationAt(kernel_, step.squaredNorm()).slope;
    result.col(j) = 2 * signal2 * slope * step.cwiseProduct(inverse_length_) +
                    2 * trend2 * (1 + 2 * z.dot(other)) * other;
  }
  return result;
}

Eigen::VectorXd Covariance::DiagonalGradient(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd z = 2 * x.array() - 1;  // k(x, x) varies by the trend alone
  return 4 * hyper_.trend * hyper_.trend * (1 + 2 * z.squaredNorm()) * z;
}

}  // namespace talus::surrogate
