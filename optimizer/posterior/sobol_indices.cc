#include "optimizer/posterior/sobol_indices.h"

#include <algorithm>

#include "optimizer/designs/design.h"

namespace talus::optimizer {

// With A and B the halves of one low-discrepancy sample, as good as independent, and Aᵢ = A with
// column i of B, the estimators of
//   total = ½ mean (f(A) - f(Aᵢ))² / V              [jansen1999],
//   first = mean (f(B) - mean f) (f(Aᵢ) - f(A)) / V   [saltelli2010].
// The second is 0 for a coordinate without an effect, however small the sample; no first exceeds
// its total.
SobolIndices EstimateSobolIndices(
    const std::function<Eigen::VectorXd(const Eigen::MatrixXd&)>& values,
    const SobolSample& sample) {
  const Points both = Sobol(sample.num_base, 2 * sample.dimension, sample.seed);
  Eigen::MatrixXd a(sample.num_base, sample.dimension), b = a;
  for (int n = 0; n < sample.num_base; ++n) {
    a.row(n) = both[static_cast<std::size_t>(n)].head(sample.dimension);
    b.row(n) = both[static_cast<std::size_t>(n)].tail(sample.dimension);
  }
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
    const double alone = ((at_b - mean) * (at_mixed - at_a)).mean();
    indices.total.push_back(variance > 0 ? std::clamp(total / variance, 0.0, 1.0) : 0);
    indices.first.push_back(variance > 0 ? std::clamp(alone / variance, 0.0, indices.total.back())
                                         : 0);
  }
  return indices;
}

}  // namespace talus::optimizer
