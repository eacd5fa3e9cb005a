// How likely the residuals of all outputs together are: their correlation, heavy tails and temper.
//
//   ln p = -Σ ln sₖ - ½ ρ(M/T) + const,   M = rᵀ R⁻¹ r
//   R = C within a test,   √(w w') C between two tests of shares w and w'
//
// r residuals of the K outputs in standard deviations sₖ, C the correlation of the leave-one-out
// residuals (residual_correlation.h), ρ heavy-tailed (robust_misfit.h), T >= 1 the temper: the
// least with which nominal 90 % regions of the outputs hold 90 % of the leave-one-out residuals.
//
// Two tests share errors of the surrogate, whose share of a test's variances is w; each has heaps
// of its own, whose scatter is independent of the other's. With C for all of it, a dozen
// evaluations that both tests have make up directions in which even small residuals are held to be
// impossible.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace talus::optimizer {

// Coverage of nominal 90 % regions of the outputs, each evaluation left out in turn.
struct LeaveOneOutCoverage {
  int count = 0;  // evaluations
  double raw = 0;
  double tempered = 0;
};

class JointMisfit {
 public:
  // `stacked`: leave-one-out residuals in standard deviations, a row for each set and scale factor,
  // NaN where there is none; `test`: the experiment that each output is of.
  JointMisfit(const Eigen::MatrixXd& stacked, const std::vector<int>& test);

  // M of each point, one a row. `share`: w of each test, one a column, in [0, 1].
  Eigen::ArrayXd Squared(const Eigen::MatrixXd& residual, const Eigen::MatrixXd& share) const;
  // Up to a constant, of points with these M; log_sd: Σ ln sₖ of each. `softness` > 0 divides the
  // misfits once more.
  Eigen::VectorXd LogDensity(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& log_sd,
                             double softness = 1) const;

  Eigen::Index num_outputs() const { return inverse_root_.rows(); }
  double temper() const { return temper_; }
  const LeaveOneOutCoverage& coverage() const { return coverage_; }

 private:
  void Temper(const Eigen::MatrixXd& stacked);

  std::vector<int> test_;
  Eigen::MatrixXd correlation_;   // C
  Eigen::MatrixXd inverse_root_;  // L⁻¹ of C = L Lᵀ
  double temper_ = 1;
  LeaveOneOutCoverage coverage_;
};

}  // namespace talus::optimizer
