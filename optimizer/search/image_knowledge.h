// The knowledge gradient (knowledge_gradient.h) where an evaluation brings an image.
//
//   KG(x) = min_a μ(a) - E[min_a (μ(a) + Σₖ (gₖ(a) sₖ(a, x) Zₖ + ½ hₖ(a) sₖ²(a, x) (Zₖ² - 1)))],
//   sₖ(a, x) = Covₖ(a, x) / √(Varₖ(x) + nₖ²)
//
// k over the modes and the reconstruction error, gₖ and hₖ the objective's first and second
// derivative by the coefficient. A sum of absolute differences is flat in the coefficients where it
// is lowest, and what is to be learnt there is in the curvature: the terms of hₖ. The -1 is the
// variance that the evaluation takes away. The minimum has no closed form: the expectation is over
// fixed draws of Z, the same at each x.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/search/image_model.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::optimizer {

class ImageKnowledge {
 public:
  // `minimisers`: where the minimum may be, one point a row. The model must outlive this.
  ImageKnowledge(const ImageModel& model, const Eigen::MatrixXd& minimisers);

  // KG of an image at each point, one a row; in units of the objective, >= 0.
  Eigen::VectorXd Gains(const Eigen::MatrixXd& points) const;

 private:
  // One of the processes that an evaluation teaches, with the objective's derivatives by its value
  // at each minimiser.
  struct Source {
    const surrogate::GaussianProcess& process;
    surrogate::AnchorPoints anchors;
    Eigen::VectorXd slope;
    Eigen::VectorXd curvature;
  };
  std::vector<Source> sources_;
  Eigen::VectorXd means_;  // of the objective at the minimisers
  Eigen::MatrixXd draws_;  // one draw a column: Z of each source, then Z² - 1 of each
};

}  // namespace talus::optimizer
