// Where a move leads, as the table of `talus sensitivity` states it.
#include "experiments/analysis/sensitivity/stated_answer.h"

#include <gtest/gtest.h>

namespace talus::analysis {
namespace stated_answer_test {

// Half of a standard error lies beyond an end of the range; it is no smaller for that.
TEST(StatedAnswer, AnErrorAtTheEndOfARangeIsWhole) {
  const optimizer::ParameterSpace space{
      .parameters = {{.name = "sliding_friction", .low = 0.2, .high = 0.6},
                     {.name = "restitution", .fixed = 0.9},
                     {.name = "rolling_friction", .low = 0.0, .high = 0.5}}};
  const StatedAnswer stated{
      .space = space, .point = Eigen::Vector2d(0.5, 0.5), .half_ranges = Eigen::Vector2d(0.1, 0.2)};
  const Foretold foretold{
      .answer = {.point = Eigen::Vector2d(1, 0.6),
                 .credible = {{.low = 0.8, .high = 1}, {.low = 0.5, .high = 0.7}}},
      .standard_error = Eigen::Vector2d(0.05, 0.05)};
  FixedMove move;
  stated.Compare(foretold, move);
  ASSERT_EQ(move.answer.size(), 2u);
  EXPECT_NEAR(move.answer[0].to, 0.6, 1e-12);
  EXPECT_NEAR(move.answer[0].standard_error, 0.05 * 0.4, 1e-12);
  EXPECT_NEAR(move.answer[0].half_ranges, 5, 1e-12);
  EXPECT_EQ(move.answer[1].parameter, "rolling_friction");
  EXPECT_NEAR(move.answer[1].standard_error, 0.05 * 0.5, 1e-12);
}

}  // namespace stated_answer_test
}  // namespace talus::analysis
