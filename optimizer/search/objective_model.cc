#include "optimizer/search/objective_model.h"

#include "optimizer/search/acquisition.h"

namespace talus::optimizer {

Eigen::VectorXd ObjectiveModel::LogImprovement(const Eigen::MatrixXd& points, double incumbent,
                                               double noise) const {
  const Moments moments = Predict(points);
  Eigen::VectorXd result(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    result[i] =
        AugmentedLogExpectedImprovement(moments.mean[i], moments.sd[i], incumbent, noise).value;
  }
  return result;
}

MomentsGradient ObjectiveModel::PredictWithGradient(const Eigen::VectorXd& x) const {
  constexpr double kStep = 1e-4;  // of the cube: far below any correlation length, above rounding
  const Eigen::Index size = x.size();
  Eigen::MatrixXd points = x.transpose().replicate(2 * size + 1, 1);
  for (Eigen::Index k = 0; k < size; ++k) {
    points(1 + 2 * k, k) += kStep;
    points(2 + 2 * k, k) -= kStep;
  }
  const Moments moments = Predict(points);
  MomentsGradient result{.mean = moments.mean[0],
                         .sd = moments.sd[0],
                         .mean_slope = Eigen::VectorXd(size),
                         .sd_slope = Eigen::VectorXd(size)};
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::Index up = 1 + 2 * k;
    result.mean_slope[k] = (moments.mean[up] - moments.mean[up + 1]) / (2 * kStep);
    result.sd_slope[k] = (moments.sd[up] - moments.sd[up + 1]) / (2 * kStep);
  }
  return result;
}

}  // namespace talus::optimizer
