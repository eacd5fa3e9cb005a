#include "optimizer/posterior/residual_correlation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace talus::optimizer {
namespace {

// The correlation of two tests' residuals in sum over K outputs, where nothing tells it.
constexpr double kSharedError = 0.5;
constexpr double kLeastEigenvalue = 0.05;

// A correlation of fewer rows tells nothing: that of one is always ±1.
constexpr double kFewest = 4;

// What pairs of outputs show of their correlation, and how much of it chance alone would show.
struct PairSums {
  double squares = 0;
  double variances = 0;

  void Add(double r, double count) {
    if (count < kFewest) return;
    squares += r * r;
    variances += (1 - r * r) * (1 - r * r) / (count - 1);
  }
  // The shrinkage of least expected squared error, in [0, 1].
  double Shrinkage() const { return squares > 0 ? std::min(1.0, variances / squares) : 1; }
};

struct CountedCorrelation {
  double correlation = 0;
  double count = 0;
};

CountedCorrelation CorrelationOf(const Eigen::MatrixXd& stacked, Eigen::Index a, Eigen::Index b) {
  double ab = 0;
  double aa = 1e-12;
  double bb = 1e-12;
  double count = 0;
  for (Eigen::Index i = 0; i < stacked.rows(); ++i) {
    const double u = stacked(i, a);
    const double v = stacked(i, b);
    if (!std::isfinite(u) || !std::isfinite(v)) continue;
    ab += u * v;
    aa += u * u;
    bb += v * v;
    count += 1;
  }
  return {.correlation = ab / std::sqrt(aa * bb), .count = count};
}

void KeepPositive(Eigen::MatrixXd& correlation) {
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(correlation, Eigen::EigenvaluesOnly)
          .eigenvalues()[0];
  if (least >= kLeastEigenvalue) return;
  const double share = (kLeastEigenvalue - least) / (1 - least);
  correlation *= 1 - share;
  correlation.diagonal().setOnes();
}

}  // namespace

Eigen::MatrixXd ResidualCorrelation(const Eigen::MatrixXd& stacked, const std::vector<int>& test) {
  const Eigen::Index size = stacked.cols();
  const auto same = [&](Eigen::Index a, Eigen::Index b) {
    return test[static_cast<std::size_t>(a)] == test[static_cast<std::size_t>(b)];
  };
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(size, size);
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> is_told(size, size);
  PairSums within;
  PairSums between;
  for (Eigen::Index a = 0; a < size; ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      const CountedCorrelation pair = CorrelationOf(stacked, a, b);
      correlation(a, b) = pair.correlation;
      is_told(a, b) = pair.count >= kFewest;
      (same(a, b) ? within : between).Add(pair.correlation, pair.count);
    }
  }
  for (Eigen::Index a = 0; a < size; ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      const double prior = same(a, b) ? 0 : kSharedError / static_cast<double>(size);
      const double share = is_told(a, b) ? (same(a, b) ? within : between).Shrinkage() : 1;
      correlation(a, b) = (1 - share) * correlation(a, b) + share * prior;
      correlation(b, a) = correlation(a, b);
    }
  }
  KeepPositive(correlation);
  return correlation;
}

}  // namespace talus::optimizer
