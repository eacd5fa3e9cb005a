// Writes the states of a simulation that are asked for at given times.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/simulation.h"

namespace talus::engine {

struct StateFormats {
  bool vtp = true;
  bool csv = false;
};

class StateWriter {
 public:
  // `times` [s] increasing; state k of them goes to state_000k.vtp and .csv in `folder`.
  StateWriter(std::filesystem::path folder, std::vector<double> times, StateFormats formats = {});

  double NextTime() const;  // [s]; infinity when none is left

  // Writes the states that are due: one that several times ask for within a step is written for
  // each of them.
  void Write(const Simulation& simulation);

  // After a restart: what was due up to `time` [s] has been written.
  void SkipUntil(double time);

 private:
  std::filesystem::path folder_;
  std::vector<double> times_;
  StateFormats formats_;
  std::size_t next_ = 0;
};

}  // namespace talus::engine
