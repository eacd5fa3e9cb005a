// The solver: a scene that advances in time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace talus::engine {

// One touching pair, for analysis and for output.
struct ContactInfo {
  std::int64_t first = 0;   // particle id
  std::int64_t second = 0;  // particle id, or -1 - wall index
  double overlap = 0;       // δ [m] (K1)
  Vec3 normal;              // n [-], from `first` to `second`
  Vec3 force;               // on `first` [N]
};

struct EnergySums {
  double translational = 0;  // Σ m v²/2 [J], at the full step
  double rotational = 0;     // Σ I ω²/2 [J], at the full step
  double potential = 0;      // -Σ m g·x [J]
};

struct SimulationState;  // engine/simulation_state.h

// What the neighbour list is like, for benchmarks and progress reports.
struct ListStatistics {
  double skin = 0;                // [m]
  std::int64_t num_rebuilds = 0;  // since the start
  std::int64_t num_pairs = 0;     // listed
  std::int64_t num_contacts = 0;  // of them, touching when the list was made
  std::int64_t num_chunks = 0;    // that threads can share
  const char* kernels = "";       // instruction set: "avx512", "avx2", "sse2"
};

class Simulation {
 public:
  // Throws base::ConfigError with every problem of the scene.
  explicit Simulation(const Scene& scene);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  // Advances by whole steps. Throws base::Error that names reason, step and particle when the run
  // blows up: NaN, a velocity beyond what gravity and cohesion can give, a sphere through a wall.
  void Advance(std::int64_t num_steps);

  std::int64_t step() const;
  double time() const;       // [s]
  double time_step() const;  // [s]
  std::int64_t num_particles() const;

  std::vector<Particle> Particles() const;    // by id, velocities at the full step
  std::vector<ContactInfo> Contacts() const;  // δ > 0 now, ordered by (first, second)
  EnergySums Energies() const;
  double MaxSpeed() const;  // of any sphere [m/s]
  const std::vector<Wall>& Walls()
      const;  // shapes as they stand now; removed ones keep their place
  ListStatistics Statistics() const;

  // From now on the wall follows `motion` (times absolute); what was prescribed before is dropped.
  void SetMotion(int wall, std::vector<MotionStep> motion);

  // Takes a wall out of the scene for good: nothing touches it any more.
  void RemoveWall(int wall);

  // Takes out every sphere for which `leaves` holds; returns how many.
  std::int64_t RemoveIf(const std::function<bool(const Particle&)>& leaves);

  // Replaces one material, so that a powder can be filled with other friction than it is tested
  // with.
  void SetMaterial(int index, const Material& material);

  // The whole state, versioned and checksummed; Restore goes on with the same bits. Restore throws
  // base::Error for a truncated, damaged or foreign text.
  std::string Checkpoint() const;
  static Simulation Restore(std::string_view bytes, int num_threads = 1);

 private:
  explicit Simulation(std::unique_ptr<SimulationState> state);
  std::unique_ptr<SimulationState> state_;
};

}  // namespace talus::engine
