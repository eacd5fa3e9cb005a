// The R-sequence [roberts2018]: a low-discrepancy sequence, the Kronecker lattice on the
// generalised golden ratio, shifted by a seed.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace talus::optimizer {

// num_points × dimension, one point a row, in the unit cube.
Eigen::MatrixXd RSequence(int num_points, int dimension, std::uint64_t seed);

}  // namespace talus::optimizer
