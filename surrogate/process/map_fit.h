// Maximum a posteriori hyper-parameters: a few local searches with analytic gradients, from the
// best of a set of starts.
#pragma once

#include <Eigen/Core>

#include "surrogate/process/likelihood.h"

namespace talus::surrogate {

struct GaussianProcessOptions;

struct MapFit {
  Eigen::VectorXd theta;  // HyperLayout's order
  double log_prior = 0;   // density of θ
};

MapFit FitHyperparameters(const PooledData& all, const HyperLayout& layout,
                          const GaussianProcessOptions& options);

}  // namespace talus::surrogate
