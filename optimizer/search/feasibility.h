// Where evaluations fail: a Gaussian process of "it worked" (1 or 0), so that a region of failures
// is avoided with a margin, and one unlucky crash does not close a region of successes.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimizer/search/history.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::optimizer {

class Feasibility {
 public:
  Feasibility() = default;  // everything works
  explicit Feasibility(const History& history);

  bool always() const { return !process_; }

  // Probability that an evaluation works, in [0, 1].
  double Probability(const Eigen::VectorXd& x) const;

  // What a point's log acquisition loses by its risk, <= 0: the logarithm of the probability p down
  // to p = 0.7, and a steep line below: an expected gain may be e^1000 times that of a safe point.
  Eigen::VectorXd Penalty(const Eigen::MatrixXd& points) const;  // one point a row
  double Penalty(const Eigen::VectorXd& x, Eigen::VectorXd* slope) const;

 private:
  std::optional<surrogate::GaussianProcess> process_;
};

}  // namespace talus::optimizer
