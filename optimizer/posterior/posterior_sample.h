// A weighted sample of the posterior, and what it tells of regions: credible levels and volumes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/random.h"

namespace talus::optimizer {

// ln p of points of the unit cube, one a row, up to a constant.
using LogDensityFunction = std::function<Eigen::VectorXd(const Eigen::MatrixXd&)>;

// ln Σ exp(x)
double LogSumExp(const Eigen::VectorXd& x);

// Rows drawn in proportion to their weight, evenly through the sum of weights, which is 1.
std::vector<Eigen::Index> Resample(const Eigen::VectorXd& weight, int count, base::Random& random);

// Systematic resampling: as many rows as `draws`, each in proportion to its weight, which need not
// sum to 1.
Eigen::MatrixXd Resampled(const Eigen::MatrixXd& draws, const Eigen::VectorXd& weight);

struct PosteriorSample {
  Eigen::MatrixXd points;         // one a row
  Eigen::VectorXd log_density;    // of each, up to a constant
  Eigen::VectorXd weight;         // of each, for expectations under the posterior; sums to 1
  Eigen::VectorXd volume;         // of each, for integrals over the cube; sums to about 1
  double region_log_density = 0;  // at the edge of the joint 90 % region

  // Sets region_log_density.
  void SetRegion();
  // Share of the posterior where the density is higher than this.
  double CredibleLevel(double log_density) const;
  double RegionVolume() const;
  // Equally likely draws.
  Eigen::MatrixXd Draws(int count, std::uint64_t seed) const;
};

}  // namespace talus::optimizer
