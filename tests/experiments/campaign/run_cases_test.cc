// Simulations beside a campaign's own trials: what is made again by a second call, and what is not.
#include "experiments/campaign/run_cases.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "experiments/campaign/answer/joint_view.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/drawn_runner.h"

namespace talus::campaign {
namespace run_cases_test {

namespace fs = std::filesystem;

class FailedCasesTest : public CampaignFixture {
 protected:
  // A case for each of these frictions; below 0.3 there is no heap.
  bool Run(const std::vector<double>& frictions, bool has_program = true) {
    const JointView view = ReadJointView(folder_);
    const CampaignParts parts{.runner = MakeDrawnRunner(view.spec, folder_),
                              .engine = std::make_unique<FakeEngine>(FakeEngineOptions{
                                  .fail_at_low = true, .no_command = !has_program})};
    return RunCases({.count = frictions.size(),
                     .at =
                         [&](std::size_t i) {
                           rigs::Case rig_case = TypicalCase(view.spec, 0, 1);
                           rig_case.powder.material.sliding_friction = frictions[i];
                           return FolderCase{.folder = Place(i), .rig_case = rig_case};
                         },
                     .time_cap = 60},
                    parts);
  }
  fs::path Place(std::size_t i) const { return folder_ / "beside" / std::to_string(i + 1); }

  fs::path folder_ = Begin(R"(, "budget": {"simulations": 4}, "workers": 1)");
};

// `talus next` simulated its failures anew at every call, and counted nothing of their time.
TEST_F(FailedCasesTest, WhatFailedBesideOthersIsNotMadeAgain) {
  ASSERT_TRUE(Run({0.2, 0.5}));
  EXPECT_TRUE(TimeOfFailure(Place(0)).has_value());
  EXPECT_FALSE(TimeOfFailure(Place(1)).has_value());
  EXPECT_TRUE(Run({0.2, 0.5}, false));  // without a program: whatever it had to run would stop it
  EXPECT_TRUE(Run({0.6, 0.5}));         // another case in the same place is none that failed
  EXPECT_FALSE(TimeOfFailure(Place(0)).has_value());
}

// Marks that an earlier call left where nothing had succeeded: a mended set-up was never asked
// again.
TEST_F(FailedCasesTest, MarksAloneAreNoReasonToLeaveOut) {
  ASSERT_TRUE(Run({0.2, 0.5}));
  fs::remove_all(Place(1));
  EXPECT_ANY_THROW(Run({0.2, 0.5}, false));
  EXPECT_FALSE(TimeOfFailure(Place(0)).has_value());
}

TEST_F(FailedCasesTest, WhereAllFailTheSetUpIsWrongAndTheyAreMadeAgain) {
  ASSERT_TRUE(Run({0.2, 0.25}));
  EXPECT_FALSE(TimeOfFailure(Place(0)).has_value());
  EXPECT_ANY_THROW(Run({0.2, 0.25}, false));
}

}  // namespace run_cases_test
}  // namespace talus::campaign
