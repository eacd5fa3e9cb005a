// engine_sizes [GRAINS [BLOCKS]]
// Cost of a particle step of settled powders whose largest grain is 1, 3, 5 and 10 times the
// smallest: as much volume of each size (on a logarithmic scale), placed densely in a tube. First
// while they settle, with lists made often, then in blocks of steps at rest.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "bench/packing.h"
#include "bench/timing.h"
#include "engine/scene/filling.h"
#include "engine/simulation.h"

namespace {

using namespace talus;

constexpr double kSmallest = 0.2e-3;  // radius [m]
constexpr std::int64_t kSettleSteps = 4000;
constexpr std::int64_t kSteps = 1000;

// The number density falls with the fourth power of the radius, so that every size has the same
// volume.
std::vector<double> Radii(double ratio, std::int64_t count) {
  std::vector<double> radii;
  for (std::int64_t k = 0; k < count; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    radii.push_back(kSmallest / std::cbrt(1 - share * (1 - std::pow(ratio, -3))));
  }
  return engine::Shuffled(std::move(radii), 1);
}

engine::Scene Bed(double ratio, std::int64_t count) {
  const std::vector<double> radii = Radii(ratio, count);
  double volume = 0;
  for (const double r : radii) volume += 4 * std::numbers::pi / 3 * r * r * r;
  const double diameter = std::cbrt(volume / 0.55 * 4 / std::numbers::pi);
  const engine::Filling filling = engine::Fill(
      radii, {.region = {.shape = engine::RegionShape::kCylinder, .diameter = diameter}});
  std::vector<engine::Particle> grains;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    grains.push_back(
        {.id = static_cast<std::int64_t>(k), .radius = radii[k], .position = filling.positions[k]});
  }
  engine::Scene scene = bench::TubeScene(std::move(grains));
  scene.materials[0].restitution = 0.5;
  scene.walls = {
      {.name = "tube",
       .shape =
           engine::OpenCylinder{
               .axis = {0, 0, 1}, .radius = diameter / 2, .length = 4 * filling.height}},
      {.name = "base", .shape = engine::Disc{.normal = {0, 0, 1}, .radius = diameter / 2}}};
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t count = argc > 1 ? std::atoll(argv[1]) : 8000;
  const int blocks = argc > 2 ? std::atoi(argv[2]) : 3;
  const double ratios[] = {1, 3, 5, 10};
  std::vector<engine::Simulation> beds;
  std::vector<double> settling;  // [s] of CPU time
  std::vector<std::int64_t> lists;
  for (const double ratio : ratios) {
    beds.emplace_back(Bed(ratio, count));
    const double cpu = bench::CpuSeconds();
    beds.back().Advance(kSettleSteps);
    settling.push_back(bench::CpuSeconds() - cpu);
    lists.push_back(beds.back().Statistics().num_rebuilds);
  }
  std::vector<double> used(beds.size(), INFINITY);  // of the fastest block [s]
  for (int block = 0; block < blocks; ++block) {
    for (std::size_t k = 0; k < beds.size(); ++k) {
      const double cpu = bench::CpuSeconds();
      beds[k].Advance(kSteps);
      used[k] = std::min(used[k], bench::CpuSeconds() - cpu);
    }
  }
  for (std::size_t k = 0; k < beds.size(); ++k) {
    const engine::ListStatistics list = beds[k].Statistics();
    const auto per_grain = [&](std::int64_t number) {
      return static_cast<double>(number) / static_cast<double>(count);
    };
    const double per_step = 1e9 / static_cast<double>(count);
    std::printf(
        "largest %2.0f times the smallest: settling %5.1f ns a grain and step (%.2f of equal "
        "grains, "
        "%lld lists), at rest %5.1f ns (%.2f), contacts %.2f, pairs %.2f\n",
        ratios[k], per_step * settling[k] / static_cast<double>(kSettleSteps),
        settling[k] / settling[0], static_cast<long long>(lists[k]),
        per_step * used[k] / static_cast<double>(kSteps), used[k] / used[0],
        per_grain(list.num_contacts), per_grain(list.num_pairs));
  }
  return 0;
}
