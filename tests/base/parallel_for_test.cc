#include "base/parallel_for.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace talus::base {
namespace parallel_for_test {

constexpr double kMuchWork = 1e9;

class ParallelForTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { SetMostLoopThreads(GetParam()); }
};

TEST_P(ParallelForTest, EveryItemIsTakenOnce) {
  std::vector<std::atomic<int>> taken(1000);
  ParallelFor({.num_items = 1000, .item_work = kMuchWork},
              [&](std::int64_t i) { ++taken[static_cast<std::size_t>(i)]; });
  for (const std::atomic<int>& times : taken) EXPECT_EQ(times, 1);
}

TEST_P(ParallelForTest, TheExceptionOfTheFirstItemLeavesTheLoop) {
  const auto run = [] {
    ParallelFor({.num_items = 100, .item_work = kMuchWork}, [](std::int64_t i) {
      if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
    });
  };
  EXPECT_THAT(run, testing::ThrowsMessage<std::runtime_error>("7"));
}

TEST_P(ParallelForTest, ALoopInsideALoopStaysOnItsThread) {
  std::atomic<int> strangers = 0;
  ParallelFor({.num_items = 8, .item_work = kMuchWork}, [&](std::int64_t) {
    const std::thread::id own = std::this_thread::get_id();
    ParallelFor({.num_items = 8, .item_work = kMuchWork}, [&](std::int64_t) {
      if (std::this_thread::get_id() != own) ++strangers;
    });
  });
  EXPECT_EQ(strangers, 0);
}

TEST_P(ParallelForTest, ASmallLoopStaysOnItsThread) {
  const std::thread::id own = std::this_thread::get_id();
  ParallelFor({.num_items = 100, .item_work = 1},
              [&](std::int64_t) { EXPECT_EQ(std::this_thread::get_id(), own); });
}

TEST_P(ParallelForTest, ThereIsNothingToDoWithoutItems) {
  ParallelFor({.num_items = 0, .item_work = kMuchWork}, [](std::int64_t) { FAIL(); });
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelForTest, testing::Values(1, 2, 3));

// Each of two items waits for the other one, which ends on two threads only.
TEST(ParallelForOnTwoThreads, RunsTwoItemsAtOnce) {
  SetMostLoopThreads(2);
  if (MostLoopThreads() < 2) GTEST_SKIP() << "built without OpenMP";
  std::atomic<int> arrived = 0, alone = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  ParallelFor({.num_items = 2, .item_work = kMuchWork}, [&](std::int64_t) {
    ++arrived;
    while (arrived < 2 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    alone += arrived < 2 ? 1 : 0;
  });
  EXPECT_EQ(alone, 0);
}

}  // namespace parallel_for_test
}  // namespace talus::base
