// How the residuals of a posterior's outputs go together.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace talus::optimizer {

// `stacked`: a row for each set and scale factor, an output a column, NaN where it was not
// simulated; `test`: the experiment that each output is of. Positive definite.
//
// Pairwise, then shrunk towards none within a test and, between tests, towards a slight one, as far
// as chance explains what the residuals show [schaefer2005]. Without that the many pairs of two
// tests, which share few evaluations, would make directions up that no residual may take.
Eigen::MatrixXd ResidualCorrelation(const Eigen::MatrixXd& stacked, const std::vector<int>& test);

}  // namespace talus::optimizer
