#include "optimizer/posterior/joint_misfit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "optimizer/posterior/residual_correlation.h"
#include "optimizer/posterior/robust_misfit.h"

namespace talus::optimizer {
namespace {

constexpr double kMostTemper = 6;
constexpr double kRegion = 0.9;  // probability of the regions of the outputs

}  // namespace

JointMisfit::JointMisfit(const Eigen::MatrixXd& stacked, const std::vector<int>& test) {
  const Eigen::MatrixXd lower = ResidualCorrelation(stacked, test).llt().matrixL();
  inverse_root_ = lower.triangularView<Eigen::Lower>().solve(
      Eigen::MatrixXd::Identity(stacked.cols(), stacked.cols()));
  Temper(stacked);
}

// A residual that is not there counts as the mean of those that are.
void JointMisfit::Temper(const Eigen::MatrixXd& stacked) {
  std::vector<double> misfits;
  for (Eigen::Index i = 0; i < stacked.rows(); ++i) {
    Eigen::VectorXd z = stacked.row(i);
    const auto there = z.array().isFinite();
    if (!there.any()) continue;
    const double share = static_cast<double>(there.count()) / static_cast<double>(z.size());
    z = there.select(z, 0);
    misfits.push_back((inverse_root_ * z).squaredNorm() / share);
  }
  coverage_.count = static_cast<int>(misfits.size());
  const double expected = RobustQuantile(stacked.cols(), kRegion);
  const auto covered = [&](double temper) {
    return static_cast<double>(std::count_if(misfits.begin(), misfits.end(),
                                             [&](double m) { return m <= temper * expected; })) /
           static_cast<double>(misfits.size());
  };
  std::vector<double> sorted = misfits;
  std::sort(sorted.begin(), sorted.end());
  const auto at = std::min(
      sorted.size() - 1,
      static_cast<std::size_t>(std::ceil(kRegion * static_cast<double>(sorted.size()))) - 1);
  temper_ = std::clamp(sorted[at] / expected * (1 + 1e-12), 1.0, kMostTemper);
  coverage_.raw = covered(1);
  coverage_.tempered = covered(temper_);
}

Eigen::ArrayXd JointMisfit::Squared(const Eigen::MatrixXd& residual) const {
  return (residual * inverse_root_.transpose()).rowwise().squaredNorm().array();
}

Eigen::VectorXd JointMisfit::LogDensity(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& log_sd,
                                        double softness) const {
  return -log_sd - 0.5 * RobustMisfit(squared / (temper_ * softness), num_outputs());
}

}  // namespace talus::optimizer
