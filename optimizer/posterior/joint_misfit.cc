#include "optimizer/posterior/joint_misfit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "optimizer/answer.h"
#include "optimizer/posterior/residual_correlation.h"
#include "optimizer/posterior/robust_misfit.h"

namespace talus::optimizer {
namespace {

constexpr double kMostTemper = 6;

}  // namespace

JointMisfit::JointMisfit(const Eigen::MatrixXd& stacked, const std::vector<int>& test)
    : test_(test), correlation_(ResidualCorrelation(stacked, test)) {
  const Eigen::MatrixXd lower = correlation_.llt().matrixL();
  inverse_root_ = lower.triangularView<Eigen::Lower>().solve(
      Eigen::MatrixXd::Identity(stacked.cols(), stacked.cols()));
  Temper(stacked);
}

// A set that not all tests have been simulated at has the region of those outputs that it has.
void JointMisfit::Temper(const Eigen::MatrixXd& stacked) {
  std::vector<double> misfits;  // M over its nominal quantile
  std::map<Eigen::Index, double> quantile;
  for (Eigen::Index i = 0; i < stacked.rows(); ++i) {
    std::vector<Eigen::Index> there;
    for (Eigen::Index k = 0; k < stacked.cols(); ++k) {
      if (std::isfinite(stacked(i, k))) there.push_back(k);
    }
    if (there.empty()) continue;
    const Eigen::VectorXd z = stacked(i, there);
    const Eigen::MatrixXd shared = correlation_(there, there);
    double& expected = quantile[z.size()];
    if (expected == 0) expected = RobustQuantile(z.size(), kRegionLevel);
    misfits.push_back(shared.llt().matrixL().solve(z).squaredNorm() / expected);
  }
  coverage_.count = static_cast<int>(misfits.size());
  if (misfits.empty()) return;
  const auto covered = [&](double temper) {
    return static_cast<double>(
               std::ranges::count_if(misfits, [&](double m) { return m <= temper; })) /
           static_cast<double>(misfits.size());
  };
  std::vector<double> sorted = misfits;
  std::sort(sorted.begin(), sorted.end());
  const auto at = std::min(
      sorted.size() - 1,
      static_cast<std::size_t>(std::ceil(kRegionLevel * static_cast<double>(sorted.size()))) - 1);
  temper_ = std::clamp(sorted[at] * (1 + 1e-12), 1.0, kMostTemper);
  coverage_.raw = covered(1);
  coverage_.tempered = covered(temper_);
}

Eigen::ArrayXd JointMisfit::Squared(const Eigen::MatrixXd& residual,
                                    const Eigen::MatrixXd& share) const {
  if (share.cols() < 2) {
    return (residual * inverse_root_.transpose()).rowwise().squaredNorm().array();
  }
  Eigen::ArrayXd squared(residual.rows());
  Eigen::MatrixXd shared = correlation_;
  for (Eigen::Index i = 0; i < residual.rows(); ++i) {
    const Eigen::RowVectorXd root = share.row(i).cwiseSqrt();
    for (Eigen::Index a = 0; a < shared.rows(); ++a) {
      for (Eigen::Index b = 0; b < a; ++b) {  // the lower triangle is all that LLT reads
        const int e = test_[static_cast<std::size_t>(a)];
        const int f = test_[static_cast<std::size_t>(b)];
        if (e != f) shared(a, b) = root[e] * root[f] * correlation_(a, b);
      }
    }
    squared[i] = shared.llt().matrixL().solve(residual.row(i).transpose()).squaredNorm();
  }
  return squared;
}

Eigen::VectorXd JointMisfit::LogDensity(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& log_sd,
                                        double softness) const {
  return -log_sd - 0.5 * RobustMisfit(squared / (temper_ * softness), num_outputs());
}

}  // namespace talus::optimizer
