// A scene so large that it is cut into more chunks than a small one has.
#include <gtest/gtest.h>

#include "base/files/file.h"
#include "tests/engine/cloud.h"

namespace talus::engine {
namespace many_chunks_test {

// 358 000 spheres collide: 32 chunks, shared by one thread and by seven.
TEST(ManyChunks, ThreadsDoNotChangeTheBits) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.models.rolling = Rolling::kEpsd;
  scene.particles = testing::Cloud({.per_side = 71, .spacing = 1.9e-3, .speed = 0.3});
  std::uint64_t one = 0;
  for (const int threads : {1, 7}) {
    scene.num_threads = threads;
    Simulation simulation(scene);
    EXPECT_EQ(simulation.Statistics().num_chunks, 32);
    simulation.Advance(30);
    EXPECT_GT(simulation.Contacts().size(), 1000u);
    const std::uint64_t bits = base::Checksum(simulation.Checkpoint());
    if (threads == 1) one = bits;
    EXPECT_EQ(bits, one) << threads << " threads";
  }
}

}  // namespace many_chunks_test
}  // namespace talus::engine
