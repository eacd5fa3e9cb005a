// Where evaluations fail, and what a search loses by going there.
#pragma once

#include <Eigen/Core>

#include "optimizer/outputs/success_model.h"
#include "optimizer/search/history.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

class Feasibility {
 public:
  Feasibility() = default;  // everything works
  explicit Feasibility(const History& history);

  bool always() const { return worked_.always(); }

  // Probability that an evaluation works, in [0, 1].
  double Probability(const Eigen::VectorXd& x) const;

  // The domain less what more probably fails than works; the domain where that is all of a list. It
  // refers to this object.
  Domain LikelyToWork(const Domain& domain) const;

  // What a point's log acquisition loses by its risk, <= 0: the logarithm of the probability p down
  // to p = 0.7, and a steep line below: an expected gain may be e^1000 times that of a safe point.
  Eigen::VectorXd Penalty(const Eigen::MatrixXd& points) const;  // one point a row
  double Penalty(const Eigen::VectorXd& x, Eigen::VectorXd* slope) const;

 private:
  SuccessModel worked_;
};

}  // namespace talus::optimizer
