// What limits the threads of a run: the work of each chunk, and what only one thread does.
//
// Every few hundred steps the probe takes each chunk's time by its thread's own clock, so that
// others who share the cores do not count, and each time that the list is made. From these follows
// how long a step would take any number of cores: each takes a row of chunks and waits for the
// slowest before it (engine/simulation_state.h, Sweep). Meeting itself, some microseconds, and
// sharing caches and memory are left out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace talus::engine {

// Of one chunk [s].
struct ChunkTimes {
  double forces = 0;  // in a step
  double motion = 0;
  double search = 0;  // when the list was made
};

struct ScalingEstimate {
  double parallel_share = 0;  // of the run's work that chunks share [-]
  double imbalance = 0;       // longest over mean forces of a chunk [-]
  std::int64_t num_chunks = 0;
  struct SpeedUp {
    int cores = 0;
    double factor = 0;  // one core's time over theirs [-]
  };
  std::vector<SpeedUp> speed_ups;
};

class ScalingProbe {
 public:
  static bool Samples(std::int64_t step) { return step % kInterval == 0; }

  // A sampled step; `alone` is what only one thread did [s]. Chunks of a member after its first
  // `reach` ones move at once.
  void AddStep(std::span<const ChunkTimes> chunks, std::int64_t reach, double alone);

  // A list has been made; `even` is work that any number of cores share evenly [s].
  void AddList(std::span<const ChunkTimes> chunks, double alone, double even);
  void AddEven(double seconds);

  // After `num_steps` steps.
  ScalingEstimate Estimate(std::int64_t num_steps) const;

 private:
  static constexpr std::int64_t kInterval = 256;
  static constexpr int kCores[] = {1, 2, 4, 16, 64, 128};
  static constexpr int kNumCores = 6;

  struct Sums {
    double shared[kNumCores] = {};  // of the critical path, for each number of cores [s]
    double alone = 0;               // [s]
    std::int64_t count = 0;
  };
  Sums steps_, lists_;
  double longest_ = 0, mean_ = 0;  // summed over the sampled steps [s]
  std::int64_t num_chunks_ = 0;
};

}  // namespace talus::engine
