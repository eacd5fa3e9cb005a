#include "experiments/analysis/sensitivity/shift_field.h"

#include <gtest/gtest.h>

namespace talus::analysis {
namespace shift_field_test {

Shift Of(double first, double second) {
  return {.mean = Eigen::Vector2d(first, second), .variance = Eigen::Vector2d(0.1, first)};
}

TEST(ShiftField, OfOneSetIsTheSameEverywhere) {
  ShiftField field;
  field.Add(Eigen::Vector2d(0.3, 0.4), Of(2, -1));
  const Eigen::MatrixXd at = field.At(Eigen::Matrix2d{{0.3, 0.4}, {0.9, 0.1}});
  EXPECT_TRUE(at.isApprox(Eigen::MatrixXd{{2, -1}, {2, -1}}, 1e-12));
}

TEST(ShiftField, IsWhatWasSimulatedAtItsSetsAndBetweenThemElsewhere) {
  ShiftField field;
  field.Add(Eigen::Vector2d(0.2, 0.5), Of(2, -1));
  field.Add(Eigen::Vector2d(0.6, 0.5), Of(4, 7));
  const Eigen::MatrixXd at =
      field.At(Eigen::MatrixXd{{0.2, 0.5}, {0.6, 0.5}, {0.4, 0.5}, {0.4, 0.9}, {0.3, 0.5}});
  EXPECT_TRUE(at.row(0).isApprox(Eigen::RowVector2d(2, -1), 1e-6));
  EXPECT_TRUE(at.row(1).isApprox(Eigen::RowVector2d(4, 7), 1e-6));
  // As far from the one as from the other.
  EXPECT_TRUE(at.row(2).isApprox(Eigen::RowVector2d(3, 3), 1e-6));
  EXPECT_TRUE(at.row(3).isApprox(Eigen::RowVector2d(3, 3), 1e-6));
  // Three times as far from the second: nine parts to one.
  EXPECT_TRUE(at.row(4).isApprox(Eigen::RowVector2d(2.2, -0.2), 1e-6));
  EXPECT_EQ(field.variance(), Eigen::VectorXd(Eigen::Vector2d(0.1, 4)));
}

}  // namespace shift_field_test
}  // namespace talus::analysis
