// Draws round weighted points: a mixture of normal kernels, whose density can be asked.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "base/random.h"

namespace talus::optimizer {

class KernelMixture {
 public:
  static constexpr int kCentres = 120;

  // Round kCentres of `points` (one a row), drawn by their weights (which sum to 1). `width`: of
  // the kernels, in the sample's own standard deviations.
  KernelMixture(const Eigen::MatrixXd& points, const Eigen::VectorXd& weight, double width,
                base::Random& random);

  // One point a row.
  Eigen::MatrixXd Draw(Eigen::Index count, base::Random& random) const;
  Eigen::VectorXd LogDensity(const Eigen::MatrixXd& points) const;

 private:
  Eigen::MatrixXd centres_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace talus::optimizer
