// How likely the residuals of all outputs together are: their correlation, heavy tails and temper.
//
//   ln p = -Σ ln sₖ - ½ ρ(M/T) + const,   M = rᵀ C⁻¹ r
//
// r residuals of the K outputs in standard deviations sₖ, C their correlation
// (residual_correlation.h), ρ heavy-tailed (robust_misfit.h), T >= 1 the temper: the least with
// which nominal 90 % regions of the outputs hold 90 % of the leave-one-out residuals.
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

  // M of each point, one a row.
  Eigen::ArrayXd Squared(const Eigen::MatrixXd& residual) const;
  // Up to a constant, of points with these M; log_sd: Σ ln sₖ of each. `softness` > 0 divides the
  // misfits once more.
  Eigen::VectorXd LogDensity(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& log_sd,
                             double softness = 1) const;

  Eigen::Index num_outputs() const { return inverse_root_.rows(); }
  double temper() const { return temper_; }
  const LeaveOneOutCoverage& coverage() const { return coverage_; }

 private:
  void Temper(const Eigen::MatrixXd& stacked);

  Eigen::MatrixXd inverse_root_;  // L⁻¹ of the correlation C = L Lᵀ
  double temper_ = 1;
  LeaveOneOutCoverage coverage_;
};

}  // namespace talus::optimizer
