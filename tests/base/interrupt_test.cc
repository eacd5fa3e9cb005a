#include "base/interrupt.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <optional>

namespace talus::base {
namespace {

volatile sig_atomic_t num_caught = 0;  // by the handler that a caller such as Python has

class InterruptGuardTest : public testing::Test {
 protected:
  InterruptGuardTest() {
    num_caught = 0;
    signal(SIGINT, [](int) { num_caught = num_caught + 1; });
    signal(SIGTERM, SIG_IGN);  // as nohup's kin leave it
  }
  ~InterruptGuardTest() override {
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
  }
};

TEST_F(InterruptGuardTest, AfterwardsTheSignalsDoWhatTheyDidBefore) {
  {
    const InterruptGuard guard;
    raise(SIGINT);
    EXPECT_EQ(guard.Asked(), Interrupt::kDrain);
    EXPECT_EQ(num_caught, 0);
  }
  raise(SIGTERM);
  raise(SIGINT);
  EXPECT_EQ(num_caught, 1);
}

TEST_F(InterruptGuardTest, AGuardThatEndsLeavesTheOthersTheirs) {
  std::optional<InterruptGuard> first(std::in_place);
  const auto raised_after = [] {
    const InterruptGuard second;
    raise(SIGINT);
    return second.Asked();
  };
  EXPECT_EQ(raised_after(), Interrupt::kDrain);
  EXPECT_EQ(first->Asked(), Interrupt::kDrain) << "the second began anew";
  raise(SIGINT);
  EXPECT_EQ(first->Asked(), Interrupt::kDrop);
  first.reset();
  EXPECT_EQ(num_caught, 0);
  EXPECT_EQ(InterruptGuard().Asked(), Interrupt::kNone) << "what the former guards noted is done";
}

}  // namespace
}  // namespace talus::base
