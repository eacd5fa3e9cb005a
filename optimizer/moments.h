// Posterior mean and standard deviation of a predicted quantity.
#pragma once

#include <Eigen/Core>

namespace talus::optimizer {

// Mean and sd of the mean function, one point each.
struct Moments {
  Eigen::VectorXd mean;
  Eigen::VectorXd sd;
};

}  // namespace talus::optimizer
