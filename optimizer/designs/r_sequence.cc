#include "optimizer/designs/r_sequence.h"

#include <cmath>

#include "base/random.h"

namespace talus::optimizer {

Eigen::MatrixXd RSequence(int num_points, int dimension, std::uint64_t seed) {
  double golden = 2;  // the root of g^(d+1) = g + 1, by fixed-point iteration
  for (int i = 0; i < 40; ++i) golden = std::pow(1 + golden, 1.0 / (dimension + 1));
  base::Random random(seed, base::Stream("lattice"));
  Eigen::MatrixXd points(num_points, dimension);
  for (int k = 0; k < dimension; ++k) {
    const double shift = random.Uniform();
    const double step = std::pow(golden, -(k + 1));
    for (int i = 0; i < num_points; ++i) {
      const double t = shift + (i + 1) * step;
      points(i, k) = t - std::floor(t);
    }
  }
  return points;
}

}  // namespace talus::optimizer
