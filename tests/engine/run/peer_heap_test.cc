// Whole heaps beside LIGGGHTS' on the same problem: what no test of a single contact sees.
#include "bench/peer_heap.h"

#include <gtest/gtest.h>

#include <span>
#include <vector>

namespace talus::engine {
namespace peer_heap_test {

// LIGGGHTS-PUBLIC 3.8.0 (Debian 12), hertz, tangential history, rolling_friction epsd, on the
// starts that `engine_heap --spheres 1100 --ratio 12 --seed 1 … 10 --data` writes, with the deck
// bench/peers/liggghts/in.heap at these parameters: spheres left on the plate.
constexpr double kLeft[] = {288, 299, 307, 298, 296, 295, 310, 291, 292, 298};
constexpr double kScatter = 6.8;  // standard deviation of them, and of ours

double Mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Heaps repeat themselves to 2 % only: contacts are chaotic. So means are compared, within three of
// the standard errors of their difference, here 3.5 % of the spheres. Ours over twelve seeds is
// 295.8. Half the rolling friction leaves 240 spheres, double 345; a sliding friction of 0.5 in
// place of 0.7 leaves 281.
TEST(PeerHeap, LeavesAsManySpheresAsLiggghts) {
  std::vector<double> left;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const bench::PeerHeap heap{.num_spheres = 1100,
                               .ratio = 12,
                               .sliding_friction = 0.7,
                               .rolling_friction = 0.4,
                               .youngs_modulus = 5e6,
                               .settle_time = 0.06,
                               .lift_time = 0.08,
                               .lift_speed = 0.1,
                               .rest_time = 0.10,
                               .seed = seed};
    Simulation simulation(heap.Scene());
    heap.Run(simulation, [](const char*) {});
    left.push_back(static_cast<double>(bench::CountOnPlate(simulation.Particles())));
  }
  const double error = kScatter * std::sqrt(1.0 / std::size(kLeft) + 1.0 / left.size());
  EXPECT_NEAR(Mean(left), Mean(kLeft), 3 * error);
}

}  // namespace peer_heap_test
}  // namespace talus::engine
