// The density of posterior draws, along one parameter and over two. Unit cube.
//
// A sum of normal kernels, one a draw, each as wide as its draw's distance from the nearest others:
// a bent valley stays thin where it is, which one width for all would smear. What
// reaches beyond the cube is mirrored at its faces.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace talus::analysis {

// Density over the unit interval at the middles of `num_cells` cells; its mean is 1.
std::vector<double> MarginalDensity(const Eigen::VectorXd& draws, int num_cells);

// For each of num_cells × num_cells cells, x fastest: the share of the draws that lie where it is
// denser, in [0, 1]. Cells below 0.5 are the joint 50 % region of the two parameters.
std::vector<double> CredibleLevels(const Eigen::MatrixXd& draws, int num_cells);

}  // namespace talus::analysis
