// engine_scaling [LARGEST_SIDE [BLOCKS]]
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

// One cube, and the fastest of its blocks of steps: others share the machine.
class Sample {
 public:
  explicit Sample(int side) : simulation_(Cube(side)) { simulation_.Advance(kWarmSteps); }

  // As they go on, the cubes shake less and the list lasts longer, so all of them do the same
  // steps.
  void Advance() {
    const double cpu = bench::CpuSeconds();
    simulation_.Advance(kSteps);
    used_ = std::min(used_, bench::CpuSeconds() - cpu);
  }
  double Nanoseconds() const { return PerParticle(used_ / kSteps) * 1e9; }  // a particle step

  void Print(double nanoseconds_of_smallest) const {
    const engine::ListStatistics list = simulation_.Statistics();
    std::printf(
        "%8lld spheres  %6.1f ns a particle step  %.2f of the smallest  contacts %.2f  pairs "
        "%.2f  lists %lld\n",
        static_cast<long long>(simulation_.num_particles()), Nanoseconds(),
        Nanoseconds() / nanoseconds_of_smallest,
        PerParticle(static_cast<double>(list.num_contacts)),
        PerParticle(static_cast<double>(list.num_pairs)),
        static_cast<long long>(list.num_rebuilds));
  }
  double PerParticle(double value) const {
    return value / static_cast<double>(simulation_.num_particles());
  }

 private:
  static constexpr int kWarmSteps = 60;
  static constexpr int kSteps = 20;

  engine::Simulation simulation_;
  double used_ = INFINITY;  // CPU time of the fastest block [s]
};

}  // namespace

// The largest first: so far the peak of the memory is its own. Then all sizes in turn, so that the
// machine's good and bad moments are shared.
int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 100;
  const int blocks = argc > 2 ? std::atoi(argv[2]) : 6;
  std::vector<Sample> samples;
  for (const int side : {100, 64, 46, 32, 16}) {
    if (side > largest) continue;
    samples.emplace_back(side);
    if (samples.size() > 1) continue;
    std::printf("%.0f B a particle of the largest\n",
                samples[0].PerParticle(bench::PeakMegabytes() * 1048576));
  }
  for (int block = 0; block < blocks; ++block) {
    for (Sample& sample : samples) sample.Advance();
  }
  for (const Sample& sample : samples) sample.Print(samples.back().Nanoseconds());
}
