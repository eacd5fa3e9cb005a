#include "optimizer/search/feasibility.h"

#include <gtest/gtest.h>

#include "optimizer/designs/r_sequence.h"

namespace talus::optimizer {
namespace feasibility_test {

// Half of sixteen evaluations fail, those with little of the first parameter.
History HalfFailed() {
  const Eigen::MatrixXd points = RSequence(16, 3, 1);
  History history{.points = Eigen::MatrixXd(0, 3), .values = {}, .failed = Eigen::MatrixXd(0, 3)};
  for (const auto& point : points.rowwise()) {
    Eigen::MatrixXd& kind = point[0] < 0.5 ? history.failed : history.points;
    kind.conservativeResize(kind.rows() + 1, Eigen::NoChange);
    kind.bottomRows(1) = point;
  }
  return history;
}

TEST(Feasibility, IsKnownWhereTrialsAreAndTakenForGrantedElsewhere) {
  const History history = HalfFailed();
  ASSERT_GT(history.failed.rows(), 5);
  const Feasibility feasibility(history);
  for (const auto& failed : history.failed.rowwise()) {
    EXPECT_LT(feasibility.Probability(failed.transpose()), 0.5);
  }
  int num_low = 0;
  const Eigen::MatrixXd even = RSequence(500, 3, 2);
  int num_working = 0;
  for (const auto& point : even.rowwise()) {
    if (point[0] < 0.6) continue;
    ++num_working;
    num_low += feasibility.Probability(point.transpose()) < 0.7;
  }
  EXPECT_LT(num_low,
            0.1 * num_working);  // a fifth, when the level went to the mean of the outcomes
}

}  // namespace feasibility_test
}  // namespace talus::optimizer
