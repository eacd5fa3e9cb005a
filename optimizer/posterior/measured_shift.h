// What the posterior would say had the experiments measured something else, from the same
// evaluations: what a systematic error of the simulations does to the answer.
//
// Where every simulation shows δ more than it does, f(x) + δ = y, the sets that fit are those that
// match y - δ as things are.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/posterior/posterior.h"

namespace talus::optimizer {

// The posterior with `by` added to what was measured, a vector of outputs for each experiment.
Posterior WithMeasuredMoved(Posterior posterior, const std::vector<Eigen::VectorXd>& by);

// The mean of the parameters moves by this matrix times a small move of what was measured: a
// parameter a row, the outputs of all experiments side by side a column each.
//
//   d⟨x⟩/dy = ⟨(x - ⟨x⟩) ∂ ln p/∂y⟩
//
// `draws` are equally likely, one a row. The derivative is taken over a standard deviation of what
// one heap scatters by.
Eigen::MatrixXd ResponseToMeasured(const Posterior& posterior, const Eigen::MatrixXd& draws);

}  // namespace talus::optimizer
