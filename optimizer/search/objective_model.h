// What a search for the next point and the answer need to know of a model of the objective, whether
// it stands on numbers (scalar_model.h) or on images.
#pragma once

#include <Eigen/Core>

#include "base/random.h"
#include "optimizer/moments.h"

namespace talus::optimizer {

struct MomentsGradient {
  double mean = 0;
  double sd = 0;
  Eigen::VectorXd mean_slope;  // d mean / dx
  Eigen::VectorXd sd_slope;    // d sd / dx
};

class ObjectiveModel {
 public:
  virtual ~ObjectiveModel() = default;

  // About how many multiplications the prediction of one point takes.
  virtual double PredictionWork() const { return 0; }

  // One point of the unit cube a row.
  virtual Moments Predict(const Eigen::MatrixXd& points) const = 0;

  // Posterior means alone, which may cost less.
  virtual Eigen::VectorXd Means(const Eigen::MatrixXd& points) const {
    return Predict(points).mean;
  }

  // Log expected improvement on `incumbent`, one point each; weighted for noise where noise > 0
  // (acquisition.h).
  virtual Eigen::VectorXd LogImprovement(const Eigen::MatrixXd& points, double incumbent,
                                         double noise) const;

  // Central differences unless a model knows better.
  virtual MomentsGradient PredictWithGradient(const Eigen::VectorXd& x) const;

  // Joint draws of the mean function: one draw a row, one point a column.
  virtual Eigen::MatrixXd Draw(const Eigen::MatrixXd& points, int num_draws,
                               base::Random random) const = 0;

  // Noise standard deviation of one evaluation at x; 0 when deterministic (TransformedModel: the
  // process's floor).
  virtual double NoiseSd(const Eigen::VectorXd& x) const = 0;
};

}  // namespace talus::optimizer
