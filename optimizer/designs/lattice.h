// The most even infinite sequence of points there is a formula for: a Kronecker lattice on the
// generalised golden ratio [roberts2018], shifted by a seed.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace talus::optimizer {

// num_points × dimension, one point a row, in the unit cube.
Eigen::MatrixXd Lattice(int num_points, int dimension, std::uint64_t seed);

}  // namespace talus::optimizer
