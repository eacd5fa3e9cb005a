// Where evaluations fail: a Gaussian process of "it worked" (1 or 0), so that a region of failures
// is avoided with a margin, and one unlucky crash does not close a region of successes.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimizer/history.h"
#include "surrogate/gaussian_process.h"

namespace talus::optimizer {

class Feasibility {
 public:
  Feasibility() = default;  // everything works
  explicit Feasibility(const History& history);

  bool always() const { return !process_; }

  // Probability that an evaluation works, clamped to [0.01, 1].
  double At(const Eigen::VectorXd& x) const;
  Eigen::VectorXd LogAt(const Eigen::MatrixXd& points) const;  // one point a row

  // Logarithm, with its slope where not null.
  double LogAt(const Eigen::VectorXd& x, Eigen::VectorXd* slope) const;

 private:
  std::optional<surrogate::GaussianProcess> process_;
};

}  // namespace talus::optimizer
