// engine_scaling [LARGEST_SIDE]
// Cost of a particle step and memory of a particle, from 4 thousand to a million spheres: cubes of
// spheres that touch all six neighbours, in a box, so that every size has the same contacts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/random.h"
#include "bench/packing.h"
#include "bench/timing.h"
#include "engine/simulation.h"

namespace {

using namespace talus;

constexpr double kDiameter = 1e-3;
constexpr double kSpacing = 0.985 * kDiameter;

engine::Scene Cube(int side) {
  std::vector<engine::Particle> spheres;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        engine::Particle p;
        p.id = static_cast<std::int64_t>(spheres.size());
        base::Random random(1, base::Stream("engine_scaling"), p.id);
        const auto at = [&](int k) {
          return kSpacing * k + 2e-3 * kDiameter * random.Uniform(-1, 1);
        };
        p.radius = kDiameter / 2;
        p.position = {at(x), at(y), at(z)};
        spheres.push_back(p);
      }
    }
  }
  engine::Scene scene = bench::TubeScene(std::move(spheres));
  scene.gravity = {0, 0, 0};
  scene.walls.clear();
  const double low = -0.49 * kDiameter, high = kSpacing * (side - 1) - low;
  for (const auto& [point, normal] : {std::pair{low, 1.0}, std::pair{high, -1.0}}) {
    for (const base::Vec3& axis : {base::Vec3{1, 0, 0}, base::Vec3{0, 1, 0}, base::Vec3{0, 0, 1}}) {
      scene.walls.push_back(
          {.name = "side", .shape = engine::Plane{.point = point * axis, .normal = normal * axis}});
    }
  }
  return scene;
}

// The same steps of every size: as they go on, the cubes shake less and the list lasts longer. The
// fastest of some blocks is what the work costs; others share the machine.
constexpr int kWarmSteps = 60;
constexpr int kBlocks = 6;
constexpr int kSteps = 20;

void Measure(int side) {
  engine::Simulation simulation(Cube(side));
  const auto num = simulation.num_particles();
  simulation.Advance(kWarmSteps);
  const auto rebuilds = simulation.Statistics().num_rebuilds;
  double used = INFINITY;
  for (int block = 0; block < kBlocks; ++block) {
    const double cpu = bench::CpuSeconds();
    simulation.Advance(kSteps);
    used = std::min(used, bench::CpuSeconds() - cpu);
  }
  const engine::ListStatistics list = simulation.Statistics();
  const auto per_particle = [&](double count) { return count / static_cast<double>(num); };
  std::printf(
      "%8lld spheres  %6.1f ns a particle step  %5.0f B a particle  contacts %.2f  pairs %.2f  "
      "rebuilds %lld\n",
      static_cast<long long>(num), per_particle(used / kSteps) * 1e9,
      per_particle(bench::PeakMegabytes() * 1048576),
      per_particle(static_cast<double>(list.num_contacts)),
      per_particle(static_cast<double>(list.num_pairs)),
      static_cast<long long>(list.num_rebuilds - rebuilds));
}

}  // namespace

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 100;
  for (const int side : {16, 32, 46, 64, 100}) {
    if (side <= largest) Measure(side);
  }
}
