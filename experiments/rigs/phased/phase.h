// A phase of a bulk test: a change of the scene at its start, a criterion or a cap for its end.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/field.h"

namespace talus::rigs {

// How a phase ended.
enum class PhaseEnd { kNone, kPoured, kTapped, kAtRest, kCleared, kTimeCap, kEmpty, kDone };
constexpr PhaseEnd LastOf(PhaseEnd) { return PhaseEnd::kDone; }

struct Phase {
  std::string name;
  PhaseEnd ends_with = PhaseEnd::kDone;  // by its criterion
  std::function<bool()> criterion{};     // asked at each look; none: it lasts until its cap
  double hold_time = 0;                  // that the criterion must hold for [s]
  std::function<double()> cap{};         // how long it lasts at most [s]
  PhaseEnd at_cap = PhaseEnd::kTimeCap;
  std::string cap_warning{};      // where a cap is worth one; default: a general sentence
  bool filmed = false;            // a camera takes its pictures in it
  std::function<void()> begin{};  // what changes in the scene
  std::function<void()> end{};    // what is measured
};

struct PhaseRecord {
  PhaseEnd reason = PhaseEnd::kNone;
  double start_time = 0;    // [s]
  double end_time = 0;      // [s]
  std::int64_t steps = 0;   // of the phase
  double energy_ratio = 0;  // mean kinetic energy of a grain / (m g d) at its last check [-]

  static constexpr base::FieldKey kKeys[] = {{"start_time", "start_time_s"},
                                             {"end_time", "end_time_s"}};
  TALUS_FIELDS(reason, start_time, end_time, steps, energy_ratio);
};

}  // namespace talus::rigs
