// Something that advances a simulation to its end in short slices, so that whoever drives it can
// show progress, save checkpoints and stop in between.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace talus::engine {

struct RunProgress {
  std::string phase;
  double time = 0;      // simulated [s]
  double end_time = 0;  // expected or capped [s]; 0 when not known
  std::int64_t num_particles = 0;
  std::int64_t step = 0;
  double particle_steps = 0;  // since the start, across restarts
};

// What the work has cost, across restarts.
struct RunTiming {
  double wall_time = 0;  // [s]
  double cpu_time = 0;   // [s]
};

class Run {
 public:
  virtual ~Run() = default;

  // Advances by a slice that takes a fraction of a second; false when the run has ended.
  virtual bool Advance() = 0;

  virtual RunProgress Progress() const = 0;

  // What has happened since the last call, a line each.
  virtual std::vector<std::string> TakeMessages() = 0;

  // The whole state; the same kind of run goes on from it with the same bits.
  virtual std::string Checkpoint(const RunTiming& timing) const = 0;

  // Writes what the run is for, result.json last.
  virtual void WriteResults(const RunTiming& timing) const = 0;
};

// Steps that take about a tenth of a second at the speed of one core.
inline std::int64_t SliceSteps(std::int64_t num_particles) {
  constexpr std::int64_t kParticleSteps = 1'000'000;
  return 1 + kParticleSteps / (num_particles + 100);
}

// What is read of one at most [bytes]: a full-scale bed's takes gigabytes.
inline constexpr std::uint64_t kLargestCheckpoint = std::uint64_t{1} << 40;

// A checkpoint of a run: what it is a run of, its own state as text, and the engine's.
struct RunCheckpoint {
  std::uint64_t input_hash = 0;  // of the complete input
  RunTiming timing;
  std::string state;       // one line
  std::string simulation;  // engine::Simulation::Checkpoint
};
std::string Pack(RunCheckpoint checkpoint);  // in the memory of `simulation`, where that has room

// Throws base::Error for a truncated, damaged or foreign text.
RunCheckpoint Unpack(const std::string& bytes);

}  // namespace talus::engine
