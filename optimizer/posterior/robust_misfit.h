// A misfit of K outputs that is Gaussian near zero and heavy-tailed far out, so that one odd output
// does not decide alone.
//
//   ρ(M) = M for M <= K,   K + (ν + K) ln((ν + M)/(ν + K)) beyond,   ν = 8
//
// Beyond K it grows as that of a Student-t of ν degrees of freedom does. Below K a Student-t would
// sharpen the misfit, as it takes small residuals for a sign that all errors are smaller than
// stated.
#pragma once

#include <Eigen/Core>

namespace talus::optimizer {

// `squared`: M >= 0 of each point; `num_outputs`: K.
Eigen::ArrayXd RobustMisfit(const Eigen::ArrayXd& squared, Eigen::Index num_outputs);

// The value that M stays below with this probability, in (0, 1), where the density of the residuals
// is exp(-ρ/2).
double RobustQuantile(Eigen::Index num_outputs, double probability);

}  // namespace talus::optimizer
