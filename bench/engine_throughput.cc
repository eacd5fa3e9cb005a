// engine_throughput PACKING.csv [--steps N] [--warm N] [--blocks N] [--threads N]
//   [--adhesion none|dmt|jkr] [--rolling none|constant|viscous|epsd] [--gamma J/m2]
// Million particle steps a second of a settled packing, with what the neighbour list settled at.
// With threads, blocks on one thread and on all of them take turns. TALUS_SIMD=avx2 or sse2
// measures narrower instruction sets.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "bench/packing.h"
#include "bench/timing.h"
#include "engine/simulation.h"

namespace {

using namespace talus;

using bench::CpuSeconds, bench::WallSeconds;

template <class Enum>
Enum Named(const std::string& name) {
  for (const auto& [known, value] : base::Names<Enum>::kList) {
    if (name == known) return value;
  }
  throw base::Error("no law is called " + name);
}

using Options = std::map<std::string, std::string>;

double Number(const Options& options, const char* key, double value) {
  return options.contains(key) ? std::stod(options.at(key)) : value;
}

engine::Scene SceneOf(const std::string& path, const Options& options) {
  engine::Scene scene = bench::TubeScene(bench::ReadPacking(path));
  scene.materials[0].surface_energy = Number(options, "--gamma", 1e-3);
  if (options.contains("--adhesion")) {
    scene.models.adhesion = Named<engine::Adhesion>(options.at("--adhesion"));
  }
  if (options.contains("--rolling")) {
    scene.models.rolling = Named<engine::Rolling>(options.at("--rolling"));
  }
  return scene;
}

// Advances and says how fast; returns the wall time [s].
double RunBlock(engine::Simulation& simulation, std::int64_t steps) {
  const auto rebuilds = simulation.Statistics().num_rebuilds;
  const double cpu = CpuSeconds(), wall = WallSeconds();
  simulation.Advance(steps);
  const double cpu_used = CpuSeconds() - cpu, wall_used = WallSeconds() - wall;
  const double work = static_cast<double>(simulation.num_particles() * steps) / 1e6;
  const engine::ListStatistics list = simulation.Statistics();
  const auto per_particle = [&](std::int64_t count) {
    return static_cast<double>(count) / static_cast<double>(simulation.num_particles());
  };
  std::printf(
      "%-7s %7lld spheres  %6.2f Mps/s wall  %6.2f Mps/s cpu  contacts %.2f  pairs %.2f  skin "
      "%.1f um  rebuilds %lld  kinetic energy %.3g J\n",
      list.kernels, static_cast<long long>(simulation.num_particles()), work / wall_used,
      work / cpu_used, per_particle(list.num_contacts), per_particle(list.num_pairs),
      1e6 * list.skin, static_cast<long long>(list.num_rebuilds - rebuilds),
      simulation.Energies().translational);
  return wall_used;
}

void Run(const std::string& path, const Options& options) {
  engine::Scene scene = SceneOf(path, options);
  const bool large = scene.particles.size() > 10000;
  const auto steps = static_cast<std::int64_t>(Number(options, "--steps", large ? 400 : 2000));
  const auto warm = static_cast<std::int64_t>(Number(options, "--warm", large ? 200 : 600));
  const int num_threads = static_cast<int>(Number(options, "--threads", 1));
  std::vector<engine::Simulation> simulations;
  for (const int threads : {1, num_threads}) {
    if (threads == 1 && !simulations.empty()) continue;
    scene.num_threads = threads;
    simulations.emplace_back(scene);
    simulations.back().Advance(warm);
  }
  std::vector<double> fastest(simulations.size(), INFINITY);  // wall time of a block [s]
  for (int block = 0; block < static_cast<int>(Number(options, "--blocks", 3)); ++block) {
    for (std::size_t k = 0; k < simulations.size(); ++k) {
      fastest[k] = std::min(fastest[k], RunBlock(simulations[k], steps));
    }
  }
  if (num_threads > 1) {
    std::printf("%d threads are %.2f times one, in the fastest block of each\n", num_threads,
                fastest[0] / fastest[1]);
  }
  std::printf("peak memory %.0f MB\n", bench::PeakMegabytes());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2 || argc % 2 != 0) {
      std::fputs("engine_throughput PACKING.csv [--steps N] [--threads N] …\n", stderr);
      return base::kExitBadInput;
    }
    Options options;
    for (int i = 2; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
    Run(argv[1], options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return base::kExitFailed;
  }
  return base::kExitDone;
}
