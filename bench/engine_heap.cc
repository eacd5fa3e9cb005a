// engine_heap [--spheres N] [--ratio D/d] [--sliding MU] [--rolling MU] [--seed N] [--threads N]
//   [--modulus Y] [--settle T] [--lift T] [--speed V] [--rest T] [--data FILE] [--csv FILE]
//   [--rayleigh F] [--share S] [--restitution E] [--elastic-limit 0|1]
// The whole lifted-tube problem of bench/peers/README.md: fill and settle 0.08 s, lift 0.20 s at
// 0.05 m/s, rest 0.22 s, steps of 0.15 Rayleigh times, unless told otherwise. Prints the time each
// part took, and the heap, which
// --csv writes. --data writes the start for LAMMPS and LIGGGHTS; --share runs only that share of
// each part; --elastic-limit 1 bounds friction by the elastic normal force (T4).
#include <cstdio>
#include <fstream>
#include <map>
#include <type_traits>

#include "bench/peer_heap.h"
#include "bench/timing.h"
#include "engine/run/state_file.h"
#include "engine/simulation.h"

namespace {

using namespace talus;

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

void Say(const char* part, const engine::Simulation& simulation) {
  const engine::ListStatistics list = simulation.Statistics();
  std::printf("%-7s %6lld spheres  cpu until now %6.1f s  skin %.1f um  rebuilds %lld\n", part,
              static_cast<long long>(simulation.num_particles()), bench::CpuSeconds(),
              1e6 * list.skin, static_cast<long long>(list.num_rebuilds));
  std::fflush(stdout);
}

void Run(std::map<std::string, std::string> options) {
  bench::PeerHeap heap;
  const auto take = [&](const char* key, auto& value) {
    if (options.contains(key))
      value = static_cast<std::decay_t<decltype(value)>>(std::stod(options[key]));
  };
  take("--spheres", heap.num_spheres);
  take("--ratio", heap.ratio);
  take("--sliding", heap.sliding_friction);
  take("--rolling", heap.rolling_friction);
  take("--modulus", heap.youngs_modulus);
  take("--restitution", heap.restitution);
  take("--elastic-limit", heap.coulomb_limit);
  take("--settle", heap.settle_time);
  take("--lift", heap.lift_time);
  take("--speed", heap.lift_speed);
  take("--rest", heap.rest_time);
  take("--seed", heap.seed);
  take("--threads", heap.num_threads);
  take("--rayleigh", heap.rayleigh_fraction);
  double share = 1;
  take("--share", share);
  for (double* time : {&heap.settle_time, &heap.lift_time, &heap.rest_time}) *time *= share;
  if (options.contains("--data")) return WriteData(options["--data"], heap.Scene());
  const double wall = bench::WallSeconds();
  engine::Simulation simulation(heap.Scene());
  heap.Run(simulation, [&](const char* part) { Say(part, simulation); });
  const std::vector<engine::Particle> particles = simulation.Particles();
  if (options.contains("--csv")) std::ofstream(options["--csv"]) << engine::CsvOf(particles);
  std::printf("heap of %lld spheres after %lld steps: wall %.1f s, cpu %.1f s, %.0f MB\n",
              static_cast<long long>(bench::CountOnPlate(particles)),
              static_cast<long long>(simulation.step()), bench::WallSeconds() - wall,
              bench::CpuSeconds(), bench::PeakMegabytes());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc % 2 == 0) {
      std::fputs("engine_heap [--spheres N] [--ratio D/d] … (see the head of the source)\n",
                 stderr);
      return base::kExitBadInput;
    }
    std::map<std::string, std::string> options;
    for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
    Run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return base::kExitFailed;
  }
  return base::kExitDone;
}
