#include "surrogate/images/principal_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace talus::surrogate {
namespace {

// Mean and modes were fitted to the same vectors and have taken up a part of what is left of them;
// of another vector more is left. Generalised cross-validation (Craven & Wahba 1979): the mean
// square of what is left times (n / (n - 1 - k))². Of few vectors that is too much.
double OfOtherVectors(Eigen::Index num_vectors, Eigen::Index num_modes) {
  constexpr double kLeastFreedom = 0.25;  // of the number of vectors
  const auto size = static_cast<double>(num_vectors);
  const double freedom = std::max(size - 1 - static_cast<double>(num_modes), kLeastFreedom * size);
  return std::pow(size / freedom, 2);
}

}  // namespace

PrincipalModes FitModes(const Eigen::MatrixXd& vectors, const Eigen::VectorXd& weights,
                        int max_modes) {
  constexpr double kRounding = 1e-12;  // share of the whole variance
  PrincipalModes modes;
  const double mean_weight = weights.mean();
  const Eigen::ArrayXd shares = weights.array() / mean_weight;
  modes.mean = (vectors.array().colwise() * shares).matrix().colwise().mean().transpose();
  const Eigen::MatrixXd centred =
      (vectors.rowwise() - modes.mean.transpose()).array().colwise() * shares.sqrt();
  // There are far fewer vectors than elements, so the small Gram matrix has all there is to know.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred * centred.transpose());
  const Eigen::VectorXd& eigenvalues = solver.eigenvalues();  // ascending
  const Eigen::Index size = eigenvalues.size();
  const double total = std::max(0.0, eigenvalues.sum());
  Eigen::Index count = 0;
  while (count < std::min<Eigen::Index>(max_modes, size) &&
         eigenvalues[size - 1 - count] > kRounding * total) {
    ++count;
  }
  if (count < size) {
    modes.next_sd = std::sqrt(mean_weight * std::max(0.0, eigenvalues[size - 1 - count]) /
                              static_cast<double>(size));
  }
  modes.basis.resize(vectors.cols(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index from = size - 1 - k;
    modes.basis.col(k) =
        centred.transpose() * solver.eigenvectors().col(from) / std::sqrt(eigenvalues[from]);
    // An eigenvector's sign is arbitrary; fixing it keeps equal data equal.
    Eigen::Index largest = 0;
    modes.basis.col(k).cwiseAbs().maxCoeff(&largest);
    if (modes.basis(largest, k) < 0) modes.basis.col(k) *= -1;
  }
  const Eigen::MatrixXd rest = centred - (centred * modes.basis) * modes.basis.transpose();
  modes.discarded = OfOtherVectors(size, count) * mean_weight *
                    rest.colwise().squaredNorm().transpose() / static_cast<double>(size);
  return modes;
}

}  // namespace talus::surrogate
