// What becomes of a trial that has ended, and what the strategy is told of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/not_known.h"
#include "experiments/campaign/plan/campaign_strategy.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/campaign/record/trial_end.h"

namespace talus::campaign {
namespace record_test {

using ::testing::SizeIs;

TEST(AddTimes, ThoseOfAllItsAttemptsAddUp) {
  journal::TrialRecord trial;
  trial.duration_s = 3;
  trial.cpu_s = 2;
  runners::FinishedJob job;
  job.duration = 4;
  job.cpu_time = 1;
  AddTimes(job, trial);
  EXPECT_EQ(trial.duration_s, 7);
  EXPECT_EQ(trial.cpu_s, 3);
  job.duration = base::kNotKnown;
  job.cpu_time = 0;
  AddTimes(job, trial);
  EXPECT_EQ(trial.duration_s, 7);
}

imaging::Profile Triangle() {
  imaging::Profile aehp{.image = {.width = 40, .height = 24, .pixels = {}},
                        .frame = {.width = 40,
                                  .height = 24,
                                  .pixel_size = 1e-3,
                                  .center_x = 20,
                                  .baseline = 22,
                                  .plate_diameter = 30e-3}};
  aehp.image.pixels.assign(40 * 24, 255);
  for (int y = 10; y < 22; ++y) {
    for (int x = 20 - (y - 9); x < 20 + (y - 9); ++x) aehp.image.at(x, y) = 0;
  }
  return aehp;
}

// A predicted heap that has no angle is not the one that is looked for.
TEST(Reference, WithoutAnAngleAFieldIsAsFarOffAsCanBe) {
  const Reference reference(Triangle(), {.objective = journal::Objective::kAor2});
  const auto objective = reference.MakeFieldObjective();
  EXPECT_NEAR(objective.metric(objective.target), 0, 1e-9);
  EXPECT_EQ(objective.metric(std::vector<float>(objective.target.size(), 0.0F)), 90);
}

TEST(Reference, TheObjectiveKnowsOfHowManyHeapsTheExperimentIsTheMean) {
  EXPECT_EQ(Reference(Triangle(), {.num_heaps = 5}).MakeFieldObjective().num_target_heaps, 5);
}

TEST(Observation, ATrialThatHasNotWhatIsMetHasFailed) {
  const Reference reference(Triangle(), {});
  journal::TrialRecord trial;
  trial.status = journal::TrialStatus::kOk;
  trial.unit = {0.5};
  EXPECT_TRUE(ObservationOf(trial, reference, {}).failed);
  trial.metrics = {{.name = "sad_mm2", .value = 3, .unit = "mm2", .undefined = {}}};
  EXPECT_FALSE(ObservationOf(trial, reference, {}).failed);
  EXPECT_EQ(ObservationOf(trial, reference, {}).value, 3);
}

// Its image is there: the posterior is of images and numbers, whatever the objective.
TEST(Observation, AnImageWithoutTheObjectivesAngleIsNoFailure) {
  const Reference reference(Triangle(), {.objective = journal::Objective::kAor2});
  journal::TrialRecord trial;
  trial.status = journal::TrialStatus::kOk;
  trial.unit = {0.5};
  trial.metrics = {{.name = "sad_mm2", .value = 3, .unit = "mm2", .undefined = {}}};
  ASSERT_FALSE(reference.Value(trial));
  EXPECT_FALSE(ObservationOf(trial, reference, {}).failed);
  EXPECT_EQ(ObservationOf(trial, reference, {}).value, kWorstAngle);
}

TEST(Stored, TrialsAreToldInTheOrderInWhichTheyEnded) {
  std::vector<journal::TrialRecord> trials(3);
  for (std::size_t i = 0; i < 3; ++i) {
    trials[i].id = static_cast<std::int64_t>(i) + 1;
    trials[i].status = journal::TrialStatus::kOk;
    trials[i].finish_order = 3 - static_cast<std::int64_t>(i);
  }
  trials[1].status = journal::TrialStatus::kRunning;
  const auto ended = InOrderOfFinish(trials);
  ASSERT_THAT(ended, SizeIs(2));
  EXPECT_EQ(ended[0].id, 3);
  EXPECT_EQ(ended[1].id, 1);
}

}  // namespace record_test
}  // namespace talus::campaign
