#include "base/random.h"

#include <gtest/gtest.h>

#include <set>

namespace talus::base {
namespace random_test {

// The first number of SplitMix64 seeded with 0, as published: every campaign's bits rest on it.
static_assert(Mix64(0x9e3779b97f4a7c15) == 0xe220a8397b1dcdaf);

TEST(Random, SameKeySameNumbersOtherKeyOthers) {
  Random a(1, 2, 3);
  Random b(1, 2, 3);
  EXPECT_EQ(a.Next(), b.Next());
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (std::uint64_t stream = 0; stream < 10; ++stream) {
      for (std::uint64_t index = 0; index < 10; ++index) {
        first.insert(Random(seed, stream, index).Next());
      }
    }
  }
  EXPECT_EQ(first.size(), 1000u);
}

// 1e5 draws: the mean of a uniform has a standard error of 9.1e-4, of a normal 3.2e-3, and the
// variance of a normal 4.5e-3; five of each are allowed. Keys in sequence, as particles use them.
TEST(Random, MomentsOfUniformAndNormalOverSequentialKeys) {
  constexpr int kDraws = 100000;
  double uniform = 0;
  double normal = 0;
  double square = 0;
  for (int i = 0; i < kDraws; ++i) {
    Random random(7, Stream("moments"), static_cast<std::uint64_t>(i));
    uniform += random.Uniform();
    const double z = random.Normal();
    normal += z;
    square += z * z;
  }
  EXPECT_NEAR(uniform / kDraws, 0.5, 4.6e-3);
  EXPECT_NEAR(normal / kDraws, 0.0, 1.6e-2);
  EXPECT_NEAR(square / kDraws, 1.0, 2.3e-2);
}

TEST(Random, BelowIsInRangeAndReachesEveryValue) {
  Random random(1, 1);
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 200; ++i) seen.insert(random.Below(5));
  EXPECT_EQ(seen, (std::set<std::uint64_t>{0, 1, 2, 3, 4}));
}

}  // namespace random_test
}  // namespace talus::base
