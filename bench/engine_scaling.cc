// engine_scaling [LARGEST_SIDE]
// Cost of a particle step and memory of a particle, from 4 thousand to a million spheres: cubes of
// spheres that touch all six neighbours, in a box, so that every size has the same contacts.
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

void Measure(int side) {
  engine::Simulation simulation(Cube(side));
  const auto num = simulation.num_particles();
  const auto steps = std::max<std::int64_t>(10'000'000 / num, 10);
  simulation.Advance(steps / 5);
  const double cpu = bench::CpuSeconds();
  simulation.Advance(steps);
  const double used = bench::CpuSeconds() - cpu;
  const engine::ListStatistics list = simulation.Statistics();
  std::printf(
      "%8lld spheres  %6.1f ns a particle step  %5.0f B a particle  contacts %.2f  pairs "
      "%.2f\n",
      static_cast<long long>(num), used / static_cast<double>(num * steps) * 1e9,
      bench::PeakMegabytes() * 1048576 / static_cast<double>(num),
      static_cast<double>(list.num_contacts) / static_cast<double>(num),
      static_cast<double>(list.num_pairs) / static_cast<double>(num));
}

}  // namespace

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 100;
  for (const int side : {16, 32, 46, 64, 100}) {
    if (side <= largest) Measure(side);
  }
}
