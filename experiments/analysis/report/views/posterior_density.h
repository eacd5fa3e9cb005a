// Posterior draws to look at: their density along one parameter, their regions over two. Unit cube.
//
// Each draw reaches as far as its nearest others are: a bent valley stays thin where it is, which
// one width for all would smear. A density is a sum of normal kernels, mirrored at the cube's
// faces.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace talus::analysis {

// Density over the unit interval at the middles of `num_cells` cells; its mean is 1. `draws` is one
// column of those of `num_parameters`.
std::vector<double> MarginalDensity(const Eigen::VectorXd& draws, int num_cells,
                                    int num_parameters = 1);

// For each of num_cells × num_cells cells, x fastest: the least of the credible levels of the draws
// that reach it, or 1. Cells below 0.9 are the shadow of the joint 90 % region on the plane of two
// parameters, whatever the others are; each draw's own cell has at most its level.
std::vector<double> ProjectedLevels(const Eigen::MatrixXd& draws, const Eigen::VectorXd& levels,
                                    int num_cells);

}  // namespace talus::analysis
