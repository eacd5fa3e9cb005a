// Threads that share a task: everyone is called, nobody goes on too early, nobody sleeps for ever.
#include "engine/threads/team.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iostream>
#include <numeric>
#include <vector>

#include "base/error.h"
#include "base/random.h"
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

// Ends the process, with 3 when the team says what it lacks.
[[noreturn]] void StartWithRoomForFewStacks(int size) {
  std::int64_t num_pages = 0;
  std::ifstream("/proc/self/statm") >> num_pages;
  const auto in_use = static_cast<rlim_t>(num_pages * ::sysconf(_SC_PAGESIZE));
  const rlimit limit{in_use + (64u << 20), in_use + (64u << 20)};
  ::setrlimit(RLIMIT_AS, &limit);
  try {
    const Team team(size);
  } catch (const base::Error& error) {
    std::cerr << error.what() << std::endl;
    std::_Exit(3);
  }
  std::_Exit(0);
}

TEST(TeamDeathTest, FewerThreadsThanAskedForAreAnErrorThatNamesThem) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve more memory than the limit";
#endif
  EXPECT_EXIT(StartWithRoomForFewStacks(1000), ::testing::ExitedWithCode(3),
              "gives [0-9]+ of 1000 threads .*take fewer threads");
}

// A chunk belongs to the member in whose part of the work its middle lies. The places are rounded
// to half a unit.
TEST(WorkShares, FollowEachOtherAndEachCutIsWithinHalfAChunkOfItsPlace) {
  WorkShares shares;
  EXPECT_EQ(shares.num_members(), 0);
  for (const int num_chunks : {0, 1, 5, 28, 128}) {
    std::vector<std::int64_t> work(num_chunks);
    for (int c = 0; c < num_chunks; ++c) {
      work[c] = 1 + static_cast<std::int64_t>(base::Random(1, base::Stream("work"), c).Below(100));
    }
    const double total = std::accumulate(work.begin(), work.end(), 0.0);
    for (const int num_members : {1, 2, 3, 16}) {
      shares.Cut(work, num_members);
      EXPECT_EQ(shares.num_members(), num_members);
      EXPECT_EQ(shares.Of(0).begin, 0);
      EXPECT_EQ(shares.Of(num_members - 1).end, num_chunks);
      for (int member = 1; member < num_members; ++member) {
        const std::int64_t cut = shares.Of(member).begin;
        EXPECT_EQ(cut, shares.Of(member - 1).end);
        const double off =
            std::accumulate(work.begin(), work.begin() + cut, 0.0) - total * member / num_members;
        if (cut > 0) {
          EXPECT_LE(off, 0.5 * static_cast<double>(work[cut - 1]));
        }
        if (cut < num_chunks) {
          EXPECT_LE(-off, 0.5 * static_cast<double>(work[cut]) + 0.5);
        }
      }
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
