#include "optimizer/posterior/sobol_indices.h"

#include <algorithm>

#include "optimizer/designs/r_sequence.h"

namespace talus::optimizer {

// Jansen's estimators [jansen1999]: with A and B independent samples and Aᵢ = A with column i of B,
//   total = ½ mean (f(A) - f(Aᵢ))² / V,   first = 1 - ½ mean (f(B) - f(Aᵢ))² / V.
SobolIndices EstimateSobolIndices(
    const std::function<Eigen::VectorXd(const Eigen::MatrixXd&)>& values,
    const SobolSample& sample) {
  const Eigen::MatrixXd both = RSequence(sample.num_base, 2 * sample.dimension, sample.seed);
  const Eigen::MatrixXd a = both.leftCols(sample.dimension);
  const Eigen::MatrixXd b = both.rightCols(sample.dimension);
  const Eigen::ArrayXd at_a = values(a);
  const Eigen::ArrayXd at_b = values(b);
  const double mean = (at_a.mean() + at_b.mean()) / 2;
  const double variance = ((at_a - mean).square().mean() + (at_b - mean).square().mean()) / 2;
  SobolIndices indices;
  for (int i = 0; i < sample.dimension; ++i) {
    Eigen::MatrixXd mixed = a;
    mixed.col(i) = b.col(i);
    const Eigen::ArrayXd at_mixed = values(mixed);
    const double total = 0.5 * (at_a - at_mixed).square().mean();
    const double others = 0.5 * (at_b - at_mixed).square().mean();
    indices.first.push_back(variance > 0 ? std::clamp(1 - others / variance, 0.0, 1.0) : 0);
    indices.total.push_back(variance > 0 ? std::clamp(total / variance, 0.0, 1.0) : 0);
  }
  return indices;
}

}  // namespace talus::optimizer
