// engine_heap [--spheres N] [--ratio D/d] [--sliding MU] [--rolling MU] [--seed N] [--threads N]
//   [--modulus Y] [--settle T] [--lift T] [--speed V] [--rest T] [--data FILE] [--csv FILE]
//   [--share S]
// The whole lifted-tube problem of bench/peers/README.md: fill and settle 0.08 s, lift 0.20 s at
// 0.05 m/s, rest 0.22 s, unless told otherwise. Prints the time each part took, and the heap, which
// --csv writes. --data writes the start for LAMMPS and LIGGGHTS; --share runs only that share of
// each part.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "base/random.h"
#include "bench/packing.h"
#include "bench/timing.h"
#include "engine/simulation.h"
#include "engine/state_file.h"

namespace {

using namespace talus;

constexpr double kTubeRadius = 5e-3;

// A loose lattice with random offsets and velocities, as the peers start from.
std::vector<engine::Particle> LooseFill(std::int64_t count, double ratio, std::uint64_t seed) {
  const double d = 2 * kTubeRadius / ratio, spacing = 1.22 * d, jitter = 0.1 * d / std::sqrt(2.0);
  const double reach = kTubeRadius - d / 2 - 0.1 * d - 0.01 * d;
  const int half = static_cast<int>(reach / spacing) + 1;
  std::vector<engine::Particle> spheres;
  for (int layer = 0; static_cast<std::int64_t>(spheres.size()) < count; ++layer) {
    for (int x = -half; x <= half; ++x) {
      for (int y = -half; y <= half; ++y) {
        if (std::hypot(x * spacing, y * spacing) > reach) continue;
        if (static_cast<std::int64_t>(spheres.size()) == count) break;
        engine::Particle p;
        p.id = static_cast<std::int64_t>(spheres.size());
        base::Random random(seed, base::Stream("engine_heap"), p.id);
        const auto shift = [&] { return random.Uniform(-jitter, jitter); };
        p.radius = d / 2;
        p.position = {x * spacing + shift(), y * spacing + shift(),
                      0.65 * d + layer * spacing + shift()};
        p.velocity = 0.06 * base::Vec3{random.Normal(), random.Normal(), random.Normal()};
        spheres.push_back(p);
      }
    }
  }
  return spheres;
}

void WriteData(const std::string& path, const engine::Scene& scene) {
  std::ofstream file(path);
  file.precision(9);
  file << "start\n\n"
       << scene.particles.size()
       << " atoms\n1 atom types\n\n-0.008 0.008 xlo xhi\n-0.008 0.008 ylo yhi\n-0.004 0.06 zlo "
          "zhi\n\nAtoms\n\n";
  for (const engine::Particle& p : scene.particles) {
    file << p.id + 1 << " 1 " << 2 * p.radius << ' ' << scene.materials[0].density << ' '
         << p.position.x << ' ' << p.position.y << ' ' << p.position.z << '\n';
  }
  file << "\nVelocities\n\n";
  for (const engine::Particle& p : scene.particles) {
    file << p.id + 1 << ' ' << p.velocity.x << ' ' << p.velocity.y << ' ' << p.velocity.z
         << " 0 0 0\n";
  }
}

bool OnPlate(const engine::Particle& p) {
  return std::hypot(p.position.x, p.position.y) < kTubeRadius && p.position.z > 0;
}

bool Leaves(const engine::Particle& p) {
  return std::fabs(p.position.x) > 8e-3 || std::fabs(p.position.y) > 8e-3 || p.position.z < -4e-3;
}

void RunPart(engine::Simulation& simulation, const char* name, double seconds) {
  const double cpu = bench::CpuSeconds(), wall = bench::WallSeconds();
  const auto end = simulation.step() + std::llround(seconds / simulation.time_step());
  while (simulation.step() < end) {
    simulation.Advance(std::min<std::int64_t>(500, end - simulation.step()));
    simulation.RemoveIf(Leaves);
  }
  const engine::ListStatistics list = simulation.Statistics();
  std::printf("%-7s %6lld spheres  wall %6.1f s  cpu %6.1f s  skin %.1f um  rebuilds %lld\n", name,
              static_cast<long long>(simulation.num_particles()), bench::WallSeconds() - wall,
              bench::CpuSeconds() - cpu, 1e6 * list.skin,
              static_cast<long long>(list.num_rebuilds));
  std::fflush(stdout);
}

void Run(std::map<std::string, std::string> options) {
  const auto number = [&](const char* key, double value) {
    return options.contains(key) ? std::stod(options[key]) : value;
  };
  engine::Scene scene = bench::TubeScene(
      LooseFill(static_cast<std::int64_t>(number("--spheres", 4000)), number("--ratio", 18),
                static_cast<std::uint64_t>(number("--seed", 1))));
  scene.materials[0].sliding_friction = number("--sliding", 0.5);
  scene.materials[0].rolling_friction = number("--rolling", 0.1);
  scene.materials[0].youngs_modulus = number("--modulus", 26.25e6);
  scene.num_threads = static_cast<int>(number("--threads", 1));
  std::get<engine::OpenCylinder>(scene.walls[0].shape).length = 0.06;
  if (options.contains("--data")) return WriteData(options["--data"], scene);
  const double share = number("--share", 1);
  const double cpu = bench::CpuSeconds(), wall = bench::WallSeconds();
  engine::Simulation simulation(scene);
  RunPart(simulation, "settle", number("--settle", 0.08) * share);
  simulation.SetMotion(0,
                       {{.time = simulation.time(), .velocity = {0, 0, number("--speed", 0.05)}}});
  RunPart(simulation, "lift", number("--lift", 0.20) * share);
  simulation.RemoveWall(0);
  RunPart(simulation, "rest", number("--rest", 0.22) * share);
  const std::vector<engine::Particle> particles = simulation.Particles();
  const auto heap = std::count_if(particles.begin(), particles.end(), OnPlate);
  if (options.contains("--csv")) {
    std::ofstream(options["--csv"]) << engine::CsvOf(particles);
  }
  std::printf("heap of %lld spheres after %lld steps: wall %.1f s, cpu %.1f s, %.0f MB\n",
              static_cast<long long>(heap), static_cast<long long>(simulation.step()),
              bench::WallSeconds() - wall, bench::CpuSeconds() - cpu, bench::PeakMegabytes());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::map<std::string, std::string> options;
    for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
    Run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return base::kExitFailed;
  }
  return base::kExitDone;
}
