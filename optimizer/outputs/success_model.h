// Where something works, or exists: a Gaussian process of "it does" (1 or 0), so that a region
// where it does not has a margin, and one unlucky case does not close a region where it does.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "surrogate/process/gaussian_process.h"

namespace talus::optimizer {

class SuccessModel {
 public:
  SuccessModel() = default;  // always
  // `worked` is 1 or 0, one point a row; always where it never failed.
  SuccessModel(const Eigen::MatrixXd& points, const Eigen::VectorXd& worked);

  bool always() const { return !process_; }

  // In [0, 1], one point a row.
  Eigen::VectorXd Probability(const Eigen::MatrixXd& points) const;

  // Not where it always does: the same, neither cut to [0, 1].
  const surrogate::GaussianProcess& process() const { return *process_; }

 private:
  std::optional<surrogate::GaussianProcess> process_;
};

}  // namespace talus::optimizer
