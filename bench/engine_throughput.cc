// engine_throughput PACKING.csv [--steps N] [--warm N] [--blocks N] [--threads N]
//   [--adhesion none|dmt|jkr] [--rolling none|constant|viscous|epsd] [--gamma J/m2]
// Million particle steps a second of a settled packing, with what the neighbour list settled at.
// TALUS_SIMD=avx2 or sse2 measures narrower instruction sets.
#include <cstdio>
#include <cstring>
#include <map>

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

void Run(const std::string& path, std::map<std::string, std::string> options) {
  const auto number = [&](const char* key, double value) {
    return options.contains(key) ? std::stod(options[key]) : value;
  };
  engine::Scene scene = bench::TubeScene(bench::ReadPacking(path));
  const bool large = scene.particles.size() > 10000;
  const auto steps = static_cast<std::int64_t>(number("--steps", large ? 400 : 2000));
  const auto warm = static_cast<std::int64_t>(number("--warm", large ? 200 : 600));
  scene.num_threads = static_cast<int>(number("--threads", 1));
  scene.materials[0].surface_energy = number("--gamma", 1e-3);
  if (options.contains("--adhesion")) {
    scene.models.adhesion = Named<engine::Adhesion>(options["--adhesion"]);
  }
  if (options.contains("--rolling")) {
    scene.models.rolling = Named<engine::Rolling>(options["--rolling"]);
  }
  engine::Simulation simulation(scene);
  simulation.Advance(warm);
  for (int block = 0; block < static_cast<int>(number("--blocks", 3)); ++block) {
    const auto rebuilds = simulation.Statistics().num_rebuilds;
    const double cpu = CpuSeconds(), wall = WallSeconds();
    simulation.Advance(steps);
    const double work = static_cast<double>(simulation.num_particles() * steps) / 1e6;
    const double cpu_used = CpuSeconds() - cpu, wall_used = WallSeconds() - wall;
    const engine::ListStatistics list = simulation.Statistics();
    const auto per_particle = [&](std::int64_t count) {
      return static_cast<double>(count) / static_cast<double>(simulation.num_particles());
    };
    std::printf(
        "%-7s %7lld spheres  %6.2f Mps/s wall  %6.2f Mps/s cpu  contacts %.2f  pairs %.2f  skin "
        "%.4f d  rebuilds %lld  kinetic energy %.3g J\n",
        list.kernels, static_cast<long long>(simulation.num_particles()), work / wall_used,
        work / cpu_used, per_particle(list.num_contacts), per_particle(list.num_pairs),
        list.skin / (2 * scene.particles[0].radius),
        static_cast<long long>(list.num_rebuilds - rebuilds), simulation.Energies().translational);
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
    std::map<std::string, std::string> options;
    for (int i = 2; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
    Run(argv[1], options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return base::kExitFailed;
  }
  return base::kExitDone;
}
