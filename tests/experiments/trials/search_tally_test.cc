// What was told of a search, counted.
#include "experiments/trials/optimize/search_tally.h"

#include <gtest/gtest.h>

namespace talus::trials {
namespace search_tally_test {

optimizer::Observation At(double x, double value) {
  return {.point = Eigen::VectorXd::Constant(1, x), .value = value};
}

TEST(SearchTally, CountsRepeatsOfASetAndThoseThatAreEqual) {
  SearchTally tally;
  for (const auto& told : {At(0.1, 5), At(0.2, 4), At(0.1, 5), At(0.1, 5.5), At(0.2, 4)}) {
    tally.Add(told);
  }
  EXPECT_EQ(tally.num_evaluations, 5);
  EXPECT_EQ(tally.num_repeats, 3);
  EXPECT_EQ(tally.num_equal_repeats, 2);
  EXPECT_EQ(tally.best->value, 4);
  EXPECT_FALSE(tally.is_constant);
}

TEST(SearchTally, FailuresAreNeitherRepeatsNorValues) {
  SearchTally tally;
  tally.Add({.point = Eigen::VectorXd::Constant(1, 0.1), .failed = true});
  tally.Add(At(0.1, 7));
  tally.Add(At(0.3, 7));
  EXPECT_EQ(tally.num_failed, 1);
  EXPECT_EQ(tally.num_repeats, 0);
  EXPECT_TRUE(tally.is_constant);
  tally.Add(At(0.4, 6));  // lower than the best so far
  EXPECT_FALSE(tally.is_constant);
}

}  // namespace search_tally_test
}  // namespace talus::trials
