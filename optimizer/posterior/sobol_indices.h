// How much of the variance of a function over the unit cube each coordinate causes, by itself
// (first order) and with all its interactions (total) [sobol2001].
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace talus::optimizer {

struct SobolIndices {
  std::vector<double> first;  // in [0, 1]; all 0 for a constant function
  std::vector<double> total;
};

struct SobolSample {
  int dimension = 1;   // 1 to 6
  int num_base = 512;  // the function is asked num_base (dimension + 2) times
  std::uint64_t seed = 1;
};

// `values`: one value a row of points.
SobolIndices EstimateSobolIndices(
    const std::function<Eigen::VectorXd(const Eigen::MatrixXd&)>& values,
    const SobolSample& sample);

}  // namespace talus::optimizer
