// engine_full_scale [STEPS [THREADS [GRAINS]]]
// The bed of examples/ti6al4v at scale factor 1 in its tube of 10 mm: grains of the mean size on a
// lattice in which each touches its six neighbours. Prints what a step and a grain cost.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/random.h"
#include "bench/timing.h"
#include "engine/simulation.h"

namespace {

using namespace talus;

constexpr double kDiameter = 70.7e-6;  // [m]
constexpr double kSpacing = 0.99 * kDiameter;
constexpr double kTubeRadius = 5e-3;  // [m]

// Upwards in layers, until there are `count`; a little off the lattice, so that it is not exact.
std::vector<engine::Particle> Grains(std::int64_t count) {
  std::vector<engine::Particle> grains;
  const int half = static_cast<int>(kTubeRadius / kSpacing) + 1;
  for (int z = 0; static_cast<std::int64_t>(grains.size()) < count; ++z) {
    for (int x = -half; x <= half; ++x) {
      for (int y = -half; y <= half; ++y) {
        if (std::hypot(x, y) * kSpacing > kTubeRadius - 0.51 * kDiameter) continue;
        if (static_cast<std::int64_t>(grains.size()) == count) break;
        engine::Particle p;
        p.id = static_cast<std::int64_t>(grains.size());
        base::Random random(1, base::Stream("engine_full_scale"), p.id);
        const auto off = [&] { return 1e-3 * kDiameter * random.Uniform(-1, 1); };
        p.radius = kDiameter / 2;
        p.position = {kSpacing * x + off(), kSpacing * y + off(),
                      kSpacing * z + 0.5 * kDiameter + off()};
        grains.push_back(p);
      }
    }
  }
  return grains;
}

engine::Scene Bed(std::int64_t count, int threads) {
  engine::Scene scene;
  scene.materials = {{.density = 4386,
                      .youngs_modulus = 26.25e6,
                      .poisson_ratio = 0.342,
                      .restitution = 0.9,
                      .sliding_friction = 0.3,
                      .rolling_friction = 0.1,
                      .rolling_damping = 0.3,
                      .surface_energy = 1e-4}};
  scene.models = {.adhesion = engine::Adhesion::kDmt, .rolling = engine::Rolling::kEpsd};
  scene.particles = Grains(count);
  scene.walls = {
      {.name = "tube",
       .shape = engine::OpenCylinder{.axis = {0, 0, 1}, .radius = kTubeRadius, .length = 0.2}},
      {.name = "base", .shape = engine::Disc{.normal = {0, 0, 1}, .radius = kTubeRadius}}};
  scene.num_threads = threads;
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t steps = argc > 1 ? std::atoll(argv[1]) : 1000;
  const int threads = argc > 2 ? std::atoi(argv[2]) : 1;
  const std::int64_t count = argc > 3 ? std::atoll(argv[3]) : 1500000;
  engine::Simulation simulation(Bed(count, threads));
  const double cpu = bench::CpuSeconds(), wall = bench::WallSeconds();
  simulation.Advance(steps);
  const double work = static_cast<double>(steps * count);
  const engine::ListStatistics list = simulation.Statistics();
  std::printf("%lld grains, %lld steps on %d threads: %.1f ns of CPU a grain and step, %.2f s\n",
              static_cast<long long>(count), static_cast<long long>(steps), threads,
              1e9 * (bench::CpuSeconds() - cpu) / work, bench::WallSeconds() - wall);
  std::printf(
      "peak memory %.0f MB, %.0f B a grain; contacts %.2f, pairs %.2f a grain; %lld lists\n",
      bench::PeakMegabytes(), 1048576 * bench::PeakMegabytes() / static_cast<double>(count),
      static_cast<double>(list.num_contacts) / static_cast<double>(count),
      static_cast<double>(list.num_pairs) / static_cast<double>(count),
      static_cast<long long>(list.num_rebuilds));
  return 0;
}
