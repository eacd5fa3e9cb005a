#include "optimizer/posterior/expected_learning.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "base/random.h"
#include "optimizer/posterior/credible_ranges.h"
#include "optimizer/posterior/posterior_sample.h"
#include "optimizer/posterior/robust_misfit.h"
#include "optimizer/posterior/sample_statistics.h"

namespace talus::optimizer {
namespace {

constexpr double kFar = 1e300;  // a log weight below all others

constexpr Eigen::Index kTruths = 64;

// Means in the measurement's standard deviations.
Eigen::MatrixXd Standardised(const Eigen::MatrixXd& mean, const Eigen::VectorXd& variance) {
  return mean.array().rowwise() / variance.array().sqrt().transpose();
}

double Bits(const Eigen::MatrixXd& z) {
  const Eigen::MatrixXd centred = z.rowwise() - z.colwise().mean();
  const Eigen::MatrixXd covariance =
      centred.transpose() * centred / static_cast<double>(z.rows() - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance, Eigen::EigenvaluesOnly);
  return 0.5 * (1 + solver.eigenvalues().array().max(0)).log().sum() / std::log(2.0);
}

// Whether each draw is the same set as this one: a posterior's draws may repeat.
Eigen::Array<bool, Eigen::Dynamic, 1> SameAs(const Eigen::MatrixXd& draws, Eigen::Index truth) {
  return (draws.rowwise() - draws.row(truth)).rowwise().squaredNorm().array() == 0;
}

// The weight of each draw, when `seen` was measured and the truth is none of them: it would take
// all the weight of a telling measurement, and leave a range of no width.
Eigen::VectorXd Weights(const Eigen::MatrixXd& z, const Eigen::RowVectorXd& seen,
                        const Eigen::Array<bool, Eigen::Dynamic, 1>& is_truth) {
  const Eigen::ArrayXd squared = (z.rowwise() - seen).rowwise().squaredNorm().array();
  Eigen::ArrayXd log_weight = -0.5 * RobustMisfit(squared, z.cols());
  if (!is_truth.all()) log_weight = is_truth.select(-kFar, log_weight);
  return (log_weight - log_weight.maxCoeff()).exp();
}

// One measurement that may come: what its truth shows, and which draws are that truth.
struct Truth {
  Eigen::RowVectorXd shows;
  Eigen::Array<bool, Eigen::Dynamic, 1> is;
};

std::vector<Truth> Truths(const Eigen::MatrixXd& draws, const Eigen::MatrixXd& z,
                          const PredictedMeasurement& measurement) {
  std::vector<Truth> truths;
  if (measurement.supposed.rows() > 0) {
    const Eigen::Array<bool, Eigen::Dynamic, 1> none =
        Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(z.rows(), false);
    const Eigen::MatrixXd supposed = Standardised(measurement.supposed, measurement.variance);
    for (const auto& shows : supposed.rowwise()) {
      truths.push_back({.shows = shows, .is = none});
    }
    return truths;
  }
  const Eigen::Index count = std::min(kTruths, draws.rows());
  for (Eigen::Index t = 0; t < count; ++t) {
    const Eigen::Index row = t * draws.rows() / count;
    truths.push_back({.shows = z.row(row), .is = SameAs(draws, row)});
  }
  return truths;
}

std::pair<Eigen::Index, Eigen::Index> MostApart(const Eigen::MatrixXd& z) {
  constexpr Eigen::Index kLooked = 300;
  std::pair<Eigen::Index, Eigen::Index> pair{0, 0};
  double most = -1;
  for (Eigen::Index i = 0; i < std::min(z.rows(), kLooked); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double apart = (z.row(i) - z.row(j)).squaredNorm();
      if (apart <= most) continue;
      most = apart;
      pair = {j, i};
    }
  }
  return pair;
}

// The value in each sorted column that this share lies below.
Eigen::VectorXd QuantileOf(const Eigen::MatrixXd& sorted, double share) {
  const auto at = static_cast<Eigen::Index>(share * static_cast<double>(sorted.rows() - 1) + 0.5);
  return sorted.row(at).transpose();
}

// The columns' ranges afterwards over those before, each at most 1, those of nuisances left out.
double VolumeLeft(const Eigen::VectorXd& after, const Eigen::VectorXd& before,
                  const std::vector<Eigen::Index>& nuisances) {
  constexpr double kNoWidth = 1e-6;
  double volume = 1;
  for (Eigen::Index k = 0; k < before.size(); ++k) {
    if (std::ranges::find(nuisances, k) != nuisances.end()) continue;
    volume *= std::min(1.0, after[k] / std::max(before[k], kNoWidth));
  }
  return volume;
}

}  // namespace

double HalfWidth90(const Eigen::VectorXd& values) {
  const Eigen::MatrixXd sorted = SortedColumns(values);
  return 0.5 * (QuantileOf(sorted, 0.5 + 0.5 * kRegionLevel)[0] -
                QuantileOf(sorted, 0.5 - 0.5 * kRegionLevel)[0]);
}

ExpectedLearning Learn(const Eigen::MatrixXd& draws, const PredictedMeasurement& measurement,
                       std::uint64_t seed, const LearningAim& aim) {
  const auto& [goal, nuisances] = aim;
  const bool has_goal = goal.size() > 0;
  ExpectedLearning learning{.bits = 0, .width = CredibleWidths90(draws, nuisances)};
  learning.narrow = learning.width;
  learning.wide = learning.width;
  if (has_goal) learning.goal_half_width = HalfWidth90(goal);
  if (measurement.mean.cols() == 0) return learning;
  const Eigen::MatrixXd z = Standardised(measurement.mean, measurement.variance);
  learning.bits = Bits(z);
  std::tie(learning.first, learning.second) = MostApart(z);
  base::Random random(seed, base::Stream("measurements to come"));
  const std::vector<Truth> truths = Truths(draws, z, measurement);
  const auto count = static_cast<double>(truths.size());
  Eigen::MatrixXd widths(static_cast<Eigen::Index>(truths.size()), draws.cols());
  if (has_goal) learning.goal_half_width = 0;
  learning.volume = 0;
  for (Eigen::Index t = 0; t < widths.rows(); ++t) {
    const Truth& truth = truths[static_cast<std::size_t>(t)];
    Eigen::RowVectorXd seen = truth.shows;
    for (double& value : seen) value += random.Normal();
    const Eigen::VectorXd weights = Weights(z, seen, truth.is);
    widths.row(t) = CredibleWidths90(Resampled(draws, weights), nuisances).transpose();
    learning.volume += VolumeLeft(widths.row(t), learning.width, nuisances) / count;
    if (!has_goal) continue;
    learning.goal_half_width += HalfWidth90(Resampled(goal, weights).col(0)) / count;
  }
  constexpr double kTenth = 0.1;
  learning.width = widths.colwise().mean().transpose();
  const Eigen::MatrixXd sorted = SortedColumns(widths);
  learning.narrow = QuantileOf(sorted, kTenth);
  learning.wide = QuantileOf(sorted, 1 - kTenth);
  return learning;
}

}  // namespace talus::optimizer
