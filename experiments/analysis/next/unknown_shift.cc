#include "experiments/analysis/next/unknown_shift.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "experiments/analysis/sensitivity/shift.h"

namespace talus::analysis {
namespace {

// Draws in, or takes back, the shift of outputs that are judged together.
void JudgeTogether(const Eigen::VectorXd& by_chance, Eigen::Ref<Eigen::VectorXd> shift) {
  double chi_square = 0;
  double degrees = 0;
  for (Eigen::Index k = 0; k < shift.size(); ++k) {
    if (!(by_chance[k] > 0)) continue;
    chi_square += shift[k] * shift[k] / by_chance[k];
    ++degrees;
  }
  shift *= IsByChance(chi_square, degrees) ? 0 : std::sqrt(1 - degrees / chi_square);
}

}  // namespace

Eigen::VectorXd PooledVariance(const std::vector<Eigen::MatrixXd>& sets) {
  const Eigen::Index num_outputs = sets.front().cols();
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(num_outputs);
  Eigen::VectorXd degrees = Eigen::VectorXd::Zero(num_outputs);
  for (const Eigen::MatrixXd& rows : sets) {
    for (Eigen::Index k = 0; k < num_outputs; ++k) {
      const ColumnMean mean = MeanOfColumn(rows, k);
      for (const double value : rows.col(k)) {
        if (std::isfinite(value)) squares[k] += (value - mean.value) * (value - mean.value);
      }
      degrees[k] += std::max(0.0, mean.count - 1);
    }
  }
  return squares.cwiseQuotient(degrees.cwiseMax(1));
}

Eigen::VectorXd ShiftBeyondChance(const MovedRows& rows) {
  auto [shift, by_chance, is_known] = ShiftOf(rows.moved, rows.base, rows.noise);
  JudgeTogether(by_chance.head(rows.num_modes), shift.head(rows.num_modes));
  for (Eigen::Index k = rows.num_modes; k < shift.size(); ++k) {
    JudgeTogether(by_chance.segment(k, 1), shift.segment(k, 1));
  }
  return shift;
}

optimizer::PredictedMeasurement WithShifts(const optimizer::PredictedMeasurement& predicted,
                                           const std::vector<Eigen::VectorXd>& shifts) {
  Eigen::MatrixXd errors = predicted.variance.asDiagonal();
  for (const Eigen::VectorXd& shift : shifts) errors += shift * shift.transpose();
  const Eigen::LLT<Eigen::MatrixXd> root(errors);
  return {.mean = root.matrixL().solve(predicted.mean.transpose()).transpose(),
          .variance = Eigen::VectorXd::Ones(predicted.variance.size())};
}

}  // namespace talus::analysis
