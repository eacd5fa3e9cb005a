#include "optimizer/outputs/success_model.h"

namespace talus::optimizer {

// Not fitted: a handful of failures says nothing of hyper-parameters. A length of a quarter of the
// range gives each failure a surrounding; noise 0.3 lets neighbours outvote it. Centred on 1: where
// nothing is known, it works.
SuccessModel::SuccessModel(const Eigen::MatrixXd& points, const Eigen::VectorXd& worked) {
  if (worked.size() == 0 || worked.minCoeff() == 1) return;
  const surrogate::GaussianProcessState state{
      .hyper = {.length = Eigen::VectorXd::Constant(points.cols(), 0.25),
                .noise = Eigen::VectorXd::Constant(1, 0.3),
                .constant = 0},
      .centre = 1,
      .scale = 0.5};
  process_ =
      surrogate::GaussianProcess::Fit({.points = points, .values = worked}, {.frozen = state});
}

Eigen::VectorXd SuccessModel::Probability(const Eigen::MatrixXd& points) const {
  if (!process_) return Eigen::VectorXd::Ones(points.rows());
  return process_->PredictAll(points).mean.cwiseMax(0).cwiseMin(1);
}

}  // namespace talus::optimizer
