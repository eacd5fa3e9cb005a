#include "optimizer/posterior/credible_ranges.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "optimizer/posterior/sample_statistics.h"

namespace talus::optimizer {
namespace credible_ranges_test {

Eigen::MatrixXd Normals(Eigen::Index num_draws, Eigen::Index dimension) {
  base::Random random(1, base::Stream("normals"));
  return Eigen::MatrixXd::NullaryExpr(num_draws, dimension, [&] { return random.Normal(); });
}

double ShareInside(const Eigen::MatrixXd& sample, const std::vector<Range>& ranges) {
  int inside = 0;
  for (Eigen::Index i = 0; i < sample.rows(); ++i) {
    bool all = true;
    for (Eigen::Index k = 0; k < sample.cols(); ++k) {
      const Range& range = ranges[static_cast<std::size_t>(k)];
      all = all && range.low <= sample(i, k) && sample(i, k) <= range.high;
    }
    inside += all ? 1 : 0;
  }
  return inside / static_cast<double>(sample.rows());
}

TEST(CredibleRanges, OfOneParameterAreItsQuantiles) {
  const Eigen::VectorXd sample = Eigen::VectorXd::LinSpaced(101, 0, 100);
  const auto ranges = CredibleRanges(sample, 0.9);
  EXPECT_EQ(ranges[0].low, 5);
  EXPECT_EQ(ranges[0].high, 95);
}

// Draws come off in groups of at most two a parameter, so the share is met to 2 · 3 of 1000.
TEST(CredibleRanges, HoldTheShareOfDrawsTogether) {
  const Eigen::MatrixXd sample = Normals(1000, 3);
  for (const double confidence : {0.5, 0.9, 0.99}) {
    const double share = ShareInside(sample, CredibleRanges(sample, confidence));
    EXPECT_GE(share, confidence);
    EXPECT_LE(share, confidence + 6e-3);
  }
}

TEST(CredibleRanges, OfParametersThatAreOneAreThoseOfOne) {
  const Eigen::VectorXd one = Normals(400, 1);
  Eigen::MatrixXd three(400, 3);
  three << one, 2 * one, -one;
  const auto ranges = CredibleRanges(three, 0.9);
  const auto single = CredibleRanges(one, 0.9);
  EXPECT_EQ(ranges[0].low, single[0].low);
  EXPECT_EQ(ranges[1].high, 2 * single[0].high);
  EXPECT_EQ(ranges[2].low, -single[0].high);
}

TEST(CredibleRanges, OfEqualDrawsAreThatDraw) {
  const Eigen::MatrixXd sample = Eigen::MatrixXd::Constant(7, 2, 0.25);
  for (const Range& range : CredibleRanges(sample, 0.9)) {
    EXPECT_EQ(range.low, 0.25);
    EXPECT_EQ(range.high, 0.25);
  }
}

TEST(RankCorrelation, IsOneAlongAnyRisingCurve) {
  Eigen::MatrixXd sample(200, 2);
  for (int i = 0; i < 200; ++i) {
    sample(i, 0) = (i * 37 % 200) / 200.0;
    sample(i, 1) = -std::exp(8 * sample(i, 0));
  }
  const Eigen::MatrixXd correlation = RankCorrelation(sample);
  EXPECT_NEAR(correlation(0, 1), -1, 1e-12);
  EXPECT_NEAR(correlation(1, 1), 1, 1e-12);
}

// Draws with replacement repeat: which of equal ones comes first says nothing.
TEST(RankCorrelation, OfValuesThatRepeatDoesNotDependOnTheirOrder) {
  Eigen::MatrixXd sample(1000, 3);
  for (Eigen::Index i = 0; i < sample.rows(); ++i) {
    sample.row(i) << static_cast<double>(i % 2), -static_cast<double>(i % 2), 0.5;
  }
  const Eigen::MatrixXd correlation = RankCorrelation(sample);
  EXPECT_NEAR(correlation(0, 1), -1, 1e-12);
  EXPECT_EQ(correlation(0, 2), 0);  // one value for all goes with nothing
  EXPECT_EQ(correlation(2, 2), 1);
}

}  // namespace credible_ranges_test
}  // namespace talus::optimizer
