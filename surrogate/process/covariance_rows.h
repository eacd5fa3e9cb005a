// The points of a covariance matrix's rows, prepared for one column after the other: what does not
// depend on the column is worked out once, and a column is arithmetic on arrays.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "surrogate/process/covariance.h"

namespace talus::surrogate {

class CovarianceRows {
 public:
  // `hyper` must outlive the rows.
  CovarianceRows(const Sites& sites, const Hyperparameters& hyper);

  Eigen::Index size() const { return coordinates_.rows(); }
  bool any_growth() const { return growth_.any(); }

  // Coordinates of the last `count` points.
  auto coordinate(Eigen::Index k, Eigen::Index count) const {
    return coordinates_.col(k).tail(count);
  }
  auto centred(Eigen::Index k, Eigen::Index count) const {  // z = 2x - 1
    return centred_.col(k).tail(count);
  }

  // What PairTerms has of the pairs of the last `count` points with one of this growth. Needs
  // hyper.scale.
  Eigen::ArrayXd TargetShares(double growth, Eigen::Index count) const;
  Eigen::ArrayXd SharedGrowth(double growth, Eigen::Index count) const;

 private:
  const Hyperparameters& hyper_;
  Eigen::ArrayXXd coordinates_;  // one point a row
  Eigen::ArrayXXd centred_;
  Eigen::ArrayXd growth_;
  // Points come from few scale factors: each has its exponential once a column.
  std::vector<double> distinct_growth_;
  Eigen::ArrayXi which_growth_;
};

}  // namespace talus::surrogate
