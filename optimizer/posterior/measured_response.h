// How the parameters follow what was measured: what chance in a measurement does to the answer.
#pragma once

#include <Eigen/Core>

#include "optimizer/posterior/posterior.h"

namespace talus::optimizer {

// The mean of the parameters moves by this matrix times a small move of what was measured: a
// parameter a row, the outputs of all experiments side by side a column each.
//
//   d⟨x⟩/dy = ⟨(x - ⟨x⟩) ∂ ln p/∂y⟩
//
// `draws` are equally likely, one a row. The derivative is taken over a standard deviation of what
// one heap scatters by.
Eigen::MatrixXd ResponseToMeasured(const Posterior& posterior, const Eigen::MatrixXd& draws);

}  // namespace talus::optimizer
