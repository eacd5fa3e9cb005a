// Principal components: the few directions in which many long vectors differ.
//
//   vectorᵢ = mean + basis coefficientsᵢ + what is discarded
#pragma once

#include <Eigen/Core>

namespace talus::surrogate {

struct PrincipalModes {
  Eigen::VectorXd mean;   // m
  Eigen::MatrixXd basis;  // m × k, orthonormal columns, the strongest first
  // For a vector of weight 1. m: variance of each element that the modes leave out, of a vector
  // that they were not fitted to.
  Eigen::VectorXd discarded;
  double next_sd = 0;  // standard deviation of the strongest mode left out; 0 where none is

  Eigen::VectorXd Coefficients(const Eigen::VectorXd& vector) const {
    return basis.transpose() * (vector - mean);
  }
};

// `vectors`: one a row. At most max_modes, fewer when the rest is rounding. `weights` > 0, one a
// vector: the inverse of its noise variance over that of a vector of weight 1.
PrincipalModes FitModes(const Eigen::MatrixXd& vectors, const Eigen::VectorXd& weights,
                        int max_modes);

}  // namespace talus::surrogate
