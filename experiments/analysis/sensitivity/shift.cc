#include "experiments/analysis/sensitivity/shift.h"

#include <cmath>

#include "experiments/campaign/answer/agreement.h"

namespace talus::analysis {

ColumnMean MeanOfColumn(const Eigen::MatrixXd& outputs, Eigen::Index k) {
  ColumnMean mean;
  for (const double value : outputs.col(k)) {
    if (!std::isfinite(value)) continue;
    mean.value += value;
    ++mean.count;
  }
  if (mean.count > 0) mean.value /= mean.count;
  return mean;
}

Shift ShiftOf(const Eigen::MatrixXd& moved, const Eigen::MatrixXd& base,
              const Eigen::VectorXd& noise) {
  Shift shift{.mean = Eigen::VectorXd::Zero(noise.size()),
              .variance = Eigen::VectorXd::Zero(noise.size()),
              .is_known = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(noise.size(), false)};
  for (Eigen::Index k = 0; k < noise.size(); ++k) {
    const ColumnMean with = MeanOfColumn(moved, k);
    const ColumnMean without = MeanOfColumn(base, k);
    if (with.count == 0 || without.count == 0) continue;
    shift.is_known[k] = true;
    shift.mean[k] = with.value - without.value;
    shift.variance[k] = noise[k] * (1 / with.count + 1 / without.count);
  }
  return shift;
}

bool IsByChance(double squares, double degrees) {
  constexpr double kSeldom = 3.0902;  // standard deviations: the 99.9 % quantile of a normal
  return !(campaign::Tension(squares, degrees) > kSeldom);
}

}  // namespace talus::analysis
