// The knowledge gradient (acquisition/knowledge_gradient.h) where an evaluation brings an image.
//
//   KG(x) = min_a μ(a) - E[min_a (μ(a) + Σₖ gₖ(a) sₖ(a, x) Zₖ)],
//   sₖ(a, x) = Covₖ(a, x) / √(Varₖ(x) + nₖ²)
//
// k over the modes and the reconstruction error, gₖ the objective's derivative by the coefficient.
// The minimum of lines in several Z has no closed form: the expectation is over fixed draws of Z,
// the same at each x.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/models/field_model.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::optimizer {

class FieldKnowledge {
 public:
  // `minimisers`: where the minimum may be, one point a row. The model must outlive this.
  FieldKnowledge(const FieldModel& model, const Eigen::MatrixXd& minimisers);

  // KG of an image at each point, one a row; in units of the objective, >= 0.
  Eigen::VectorXd Gains(const Eigen::MatrixXd& points) const;

 private:
  // One of the processes that an evaluation teaches.
  struct Source {
    const surrogate::GaussianProcess& process;
    surrogate::AnchorPoints anchors;
    Eigen::VectorXd sensitivity;  // at each minimiser
  };
  std::vector<Source> sources_;
  Eigen::VectorXd means_;    // of the objective at the minimisers
  Eigen::MatrixXd normals_;  // one draw a row, one source a column
};

}  // namespace talus::optimizer
