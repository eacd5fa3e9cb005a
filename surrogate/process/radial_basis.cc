#include "surrogate/process/radial_basis.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace talus::surrogate {
namespace {

// φ and φ'(r) / r, which is finite at 0 for the cubic and harmless there for the thin plate, since
// it is multiplied by the zero distance.
struct Radial {
  double value = 0;
  double slope_over_r = 0;
};

Radial RadialAt(RadialFunction function, double r) {
  if (function == RadialFunction::kCubic) return {.value = r * r * r, .slope_over_r = 3 * r};
  if (r == 0) return {};
  return {.value = r * r * std::log(r), .slope_over_r = 2 * std::log(r) + 1};
}

// Relative to the size of φ in the unit cube, which is about 1.
constexpr std::array kSmoothings{0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0};

}  // namespace

RadialBasis RadialBasis::Fit(const Eigen::MatrixXd& points, const Eigen::VectorXd& values,
                             RadialFunction function, std::optional<double> smoothing) {
  RadialBasis basis;
  basis.function_ = function;
  basis.points_ = points.transpose();
  const Eigen::MatrixXd centred = points.rowwise() - points.colwise().mean();
  // The plane through d + 1 points leaves nothing to be left out.
  basis.has_slope_ = points.rows() > points.cols() + 1 &&
                     Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(centred).rank() == points.cols();
  RadialBasis best = basis;
  constexpr double kRounding = 1e-9;
  double lowest = std::numeric_limits<double>::infinity();
  std::vector<double> candidates(kSmoothings.begin(), kSmoothings.end());
  if (smoothing) candidates = {*smoothing};
  for (const double candidate : candidates) {
    if (!basis.Solve(values, candidate)) continue;
    const double error = (basis.left_out_ - values).squaredNorm();
    if (error >= (1 - kRounding) * lowest) continue;  // of equally good ones the least
    lowest = error;
    best = basis;
  }
  if (std::isinf(lowest)) {  // a single point
    best.weights_ = Eigen::VectorXd::Zero(values.size());
    best.constant_ = values.mean();
    best.slope_ = Eigen::VectorXd::Zero(points.cols());
    best.left_out_ = Eigen::VectorXd::Constant(values.size(), values.mean());
  }
  return best;
}

bool RadialBasis::Solve(const Eigen::VectorXd& values, double smoothing) {
  const Eigen::Index size = values.size();
  const Eigen::Index tail = has_slope_ ? 1 + points_.rows() : 1;
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size + tail, size + tail);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      system(i, j) = RadialAt(function_, (points_.col(i) - points_.col(j)).norm()).value;
    }
    system(i, i) += smoothing;
    system(i, size) = system(size, i) = 1;
    if (!has_slope_) continue;
    system.row(i).tail(points_.rows()) = points_.col(i);
    system.col(i).tail(points_.rows()) = points_.col(i);
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(system);
  if (!factor.isInvertible()) return false;
  const Eigen::MatrixXd inverse = factor.inverse();
  const Eigen::VectorXd solution = inverse.leftCols(size) * values;
  const Eigen::VectorXd diagonal = inverse.diagonal().head(size);
  if (!(diagonal.cwiseAbs().minCoeff() > 0)) return false;
  weights_ = solution.head(size);
  constant_ = solution[size];
  slope_ = Eigen::VectorXd::Zero(points_.rows());
  if (has_slope_) slope_ = solution.tail(points_.rows());
  left_out_ = values - weights_.cwiseQuotient(diagonal);
  smoothing_ = smoothing;
  return left_out_.allFinite();
}

double RadialBasis::Predict(const Eigen::VectorXd& x) const {
  double sum = constant_ + slope_.dot(x);
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    sum += weights_[i] * RadialAt(function_, (x - points_.col(i)).norm()).value;
  }
  return sum;
}

Eigen::VectorXd RadialBasis::Gradient(const Eigen::VectorXd& x) const {
  Eigen::VectorXd sum = slope_;
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    const Eigen::VectorXd apart = x - points_.col(i);
    sum += weights_[i] * RadialAt(function_, apart.norm()).slope_over_r * apart;
  }
  return sum;
}

}  // namespace talus::surrogate
