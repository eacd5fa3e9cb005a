#include "optimizer/search/step_choice.h"

#include <gtest/gtest.h>

#include <vector>

namespace talus::optimizer {
namespace step_choice_test {

// Takes `num_steps` steps more, of which only `lucky` ones improve; says how many of them were.
int NumLucky(Step lucky, int num_steps, std::vector<double>& values) {
  int num_lucky = 0;
  for (int i = 0; i < num_steps; ++i) {
    const Eigen::Map<const Eigen::VectorXd> seen(values.data(),
                                                 static_cast<Eigen::Index>(values.size()));
    const bool improves = NextStep(seen, 3, 0) == lucky;
    num_lucky += improves ? 1 : 0;
    values.push_back(improves ? seen.minCoeff() - 1 : seen.maxCoeff());
  }
  return num_lucky;
}

// Two vain steps at most come before the lucky kind. It is left after 8 more vain ones, when of its
// 20 improvements, weight 6.4 in all, less than 2 are remembered; the other two are tried for a few
// steps each. In turn, a third of the steps would be lucky: 7 and 13.
TEST(NextStep, StaysWithTheKindThatImprovesAsLongAsItDoes) {
  for (const Step first : {Step::kGlobal, Step::kQuadratic, Step::kLocal}) {
    for (const Step second : {Step::kGlobal, Step::kQuadratic, Step::kLocal}) {
      if (first == second) continue;
      std::vector<double> values{5, 3, 4};
      EXPECT_GE(NumLucky(first, 20, values), 18);
      EXPECT_GE(NumLucky(second, 40, values), 23);
    }
  }
}

TEST(NextStep, TakesTheKindsInTurnWhileNoneImproves) {
  const Eigen::Vector4d values(5, 3, 4, 6);
  EXPECT_EQ(NextStep(values.head(3), 3, 0), Step::kGlobal);
  EXPECT_EQ(NextStep(values, 3, 0), Step::kQuadratic);
  EXPECT_EQ(NextStep(values.head(3), 3, 1), Step::kQuadratic);  // a pending one counts as vain
  EXPECT_EQ(NextStep(values, 3, 1), Step::kLocal);
}

// The first values spread by 1: a gain of 1e-7 is less than a millionth of that.
TEST(NextStep, TakesPolishingForNoImprovement) {
  std::vector<double> values{5, 3, 4, 3 - 1e-7};
  EXPECT_EQ(NextStep(Eigen::Map<Eigen::Vector4d>(values.data()), 3, 0), Step::kQuadratic);
  values.back() = 3 - 1e-5;
  EXPECT_EQ(NextStep(Eigen::Map<Eigen::Vector4d>(values.data()), 3, 0), Step::kGlobal);
}

}  // namespace step_choice_test
}  // namespace talus::optimizer
