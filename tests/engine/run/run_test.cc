#include "engine/run/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files/file.h"
#include "tests/error_in.h"
#include "tests/peak_memory.h"

namespace talus::engine {
namespace run_test {

using ::testing::HasSubstr;

const RunCheckpoint kCheckpoint{.input_hash = 0xfedcba9876543210,
                                .timing = {.wall_time = 1.0 / 3, .cpu_time = 0.25},
                                .state = "{\"a\": 1}",
                                .simulation = std::string("bytes\n\0of the engine", 20)};

std::string ErrorOf(const std::string& bytes) {
  return ErrorIn<base::Error>([&] { Unpack(bytes); });
}

TEST(RunCheckpoint, IsReadBackWhole) {
  const RunCheckpoint again = Unpack(Pack(kCheckpoint));
  EXPECT_EQ(again.input_hash, kCheckpoint.input_hash);
  EXPECT_EQ(again.timing.wall_time, kCheckpoint.timing.wall_time);
  EXPECT_EQ(again.timing.cpu_time, kCheckpoint.timing.cpu_time);
  EXPECT_EQ(again.state, kCheckpoint.state);
  EXPECT_EQ(again.simulation, kCheckpoint.simulation);
}

// A full-scale bed's was there four times at once.
TEST(RunCheckpoint, IsPackedWhereItIs) {
  constexpr std::size_t kSize = std::size_t{64} << 20;
  RunCheckpoint large = kCheckpoint;
  large.simulation.reserve(kSize + 1000);
  large.simulation.resize(kSize, 'x');
  const long before = PeakMegabytes();
  EXPECT_GT(Pack(std::move(large)).size(), kSize);
  EXPECT_LT(PeakMegabytes() - before, 32);
}

TEST(RunCheckpoint, CutAnywhereOrChangedAnywhereItIsRefused) {
  const std::string whole = Pack(kCheckpoint);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_NE(ErrorOf(whole.substr(0, i)), "") << "cut at " << i;
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_NE(ErrorOf(changed), "") << "changed at " << i;
  }
  EXPECT_THAT(ErrorOf("PK\x03\x04 something else"), HasSubstr("is not a checkpoint"));
}

// Such a text was taken apart at places that are not there. [fuzz/checkpoint]
TEST(RunCheckpoint, WithoutItsLinesItIsRefusedWhateverItsChecksum) {
  for (const std::string rest :
       {"", "fedcba9876543210", "fedcba9876543210\n1 2", "\n\n\n", "fedcba9876543210\n1 2\n{}"}) {
    EXPECT_THAT(ErrorOf("talus run 1\n" + base::Hex(base::Checksum(rest)) + "\n" + rest),
                HasSubstr("is not complete"))
        << rest;
  }
}

TEST(SliceSteps, AreFewForManyParticlesAndNeverNone) {
  EXPECT_EQ(SliceSteps(100'000'000), 1);
  EXPECT_GT(SliceSteps(2), 1000);
}

}  // namespace run_test
}  // namespace talus::engine
