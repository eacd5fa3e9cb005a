// What two batches have in common.
#include "experiments/analysis/batches/batch_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace talus::analysis {
namespace batch_warnings_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

campaign::JointView Batch(const std::string& folder, const std::string& prior = "") {
  campaign::JointView view;
  view.folder.root = folder;
  view.spec.parameters.emplace();
  if (!prior.empty()) view.spec.parameters->prior = campaign::EarlierPosterior{.from = prior};
  return view;
}

// A difference of 3 standard deviations was shown as 1.7, since the second began with what the
// first had found.
TEST(CommonPrior, OneThatIsThePriorOfTheOtherIsSaidEitherWayRound) {
  const auto february = Batch("february"), march = Batch("march", "./february/");
  EXPECT_THAT(CommonPrior(february, march),
              StartsWith("march: has the posterior of february as its "));
  EXPECT_THAT(CommonPrior(march, february),
              StartsWith("march: has the posterior of february as its prior, so that"));
}

TEST(CommonPrior, AThirdCampaignIsCommonToo) {
  EXPECT_THAT(CommonPrior(Batch("march", "january"), Batch("april", "january")),
              AllOf(StartsWith("april: has the posterior of "),
                    HasSubstr("january as its prior, as march has, so")));
}

TEST(CommonPrior, BatchesOfTheirOwnShareNothing) {
  EXPECT_EQ(CommonPrior(Batch("march"), Batch("april")), "");
  EXPECT_EQ(CommonPrior(Batch("march", "january"), Batch("april", "february")), "");
}

}  // namespace batch_warnings_test
}  // namespace talus::analysis
