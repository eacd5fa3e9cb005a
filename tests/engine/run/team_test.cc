// Threads that share a task: everyone is called, nobody goes on too early, nobody sleeps for ever.
#include "engine/threads/team.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <random>
#include <vector>

#include "engine/threads/work_shares.h"

namespace talus::engine {
namespace team_test {

// One alone, two, and more than most machines have cores.
class TeamOf : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Sizes, TeamOf, ::testing::Values(1, 2, 3, 8));

// Thousands of tasks: a wake-up that gets lost once in a while hangs the test.
TEST_P(TeamOf, EveryMemberDoesEveryTaskBeforeRunReturns) {
  Team team(GetParam());
  std::vector<int> num_done(team.size());  // plain numbers: Run itself must make them visible
  for (int task = 1; task <= 5000; ++task) {
    team.Run([&](int member) { ++num_done[member]; });
    for (const int done : num_done) ASSERT_EQ(done, task);
  }
}

TEST_P(TeamOf, SecondPartsSeeTheFirstPartsOfAllMembersBefore) {
  Team team(GetParam());
  std::vector<int> first(team.size()), seen(team.size());
  for (int task = 1; task <= 2000; ++task) {
    team.Run([&](int member) {
      first[member] = task;
      team.FinishFirstPart(member);
      team.AwaitFirstPartsBefore(member);
      seen[member] = std::accumulate(first.begin(), first.begin() + member, 0);
    });
    for (int member = 0; member < team.size(); ++member) ASSERT_EQ(seen[member], member * task);
  }
}

// Long enough between the tasks, and within them, for all waits to end in sleep.
TEST_P(TeamOf, SleepersWakeUp) {
  using namespace std::chrono_literals;
  Team team(GetParam());
  std::vector<int> num_done(team.size());
  for (int task = 0; task < 5; ++task) {
    std::this_thread::sleep_for(2ms);
    team.Run([&](int member) {
      if (member == 0) std::this_thread::sleep_for(2ms);
      team.FinishFirstPart(member);
      team.AwaitFirstPartsBefore(member);
      ++num_done[member];
    });
  }
  for (const int done : num_done) EXPECT_EQ(done, 5);
}

TEST_P(TeamOf, SharesFollowEachOtherAndDifferByOneAtMost) {
  const Team team(GetParam());
  for (const std::int64_t count : {0, 1, 4, 7, 24}) {
    std::int64_t end = 0;
    for (int member = 0; member < team.size(); ++member) {
      const Share share = team.ShareOf(member, count);
      EXPECT_EQ(share.begin, end);
      EXPECT_GE(share.end - share.begin, count / team.size());
      EXPECT_LE(share.end - share.begin, count / team.size() + 1);
      end = share.end;
    }
    EXPECT_EQ(end, count);
  }
}

// No share is further from an equal part than half a chunk at each of its ends.
TEST(WorkShares, FollowEachOtherAndHoldAboutAsMuchWork) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> any(1, 100);
  WorkShares shares;
  for (const int num_chunks : {0, 1, 5, 28, 128}) {
    std::vector<std::int64_t> work(num_chunks);
    for (std::int64_t& one : work) one = any(random);
    const std::int64_t total = std::accumulate(work.begin(), work.end(), std::int64_t{0});
    for (const int num_members : {1, 2, 3, 16}) {
      shares.Cut(work, num_members);
      std::int64_t end = 0;
      for (int member = 0; member < num_members; ++member) {
        const Share share = shares.Of(member);
        EXPECT_EQ(share.begin, end);
        end = share.end;
        const auto held =
            std::accumulate(work.begin() + share.begin, work.begin() + share.end, 0.0);
        EXPECT_NEAR(held, static_cast<double>(total) / num_members, 100);
      }
      EXPECT_EQ(end, num_chunks);
    }
  }
}

TEST(Patience, WhoSpinsInVainSpinsLessOftenUntilItHelpsAgain) {
  Patience patience;
  const auto spins_of = [&](int num_waits, bool in_vain) {
    int num_spins = 0;
    for (int wait = 0; wait < num_waits; ++wait) {
      if (!patience.SpinNow()) continue;
      ++num_spins;
      patience.Spun(in_vain);
    }
    return num_spins;
  };
  EXPECT_EQ(spins_of(100, false), 100);
  EXPECT_LT(spins_of(1000, true), 80);  // every 16th wait in the end
  EXPECT_GT(spins_of(100, false), 80);  // the 16th at the latest, then all
}

}  // namespace team_test
}  // namespace talus::engine
