// Prescribed motion: what a wall, or a turning gravity, does during one step.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/problems.h"
#include "engine/bodies/wall.h"

namespace talus::engine {

// Mean velocities over [time, time + Δt]: they take the pivot to where its motion leads, whatever
// begins or ends within the step, so that nothing drifts.
struct MeanMotion {
  Vec3 velocity;          // of the pivot [m/s]
  Vec3 angular_velocity;  // [rad/s]
};
MeanMotion MotionOver(std::span<const MotionStep> motion, double time, double time_step);
Vec3 TurnOver(std::span<const TurnStep> turns, double time, double time_step);  // [rad/s]

// Largest velocity that the pivot is to have at any time [m/s], and largest turning [rad/s].
double MaxVelocity(std::span<const MotionStep> motion);
double MaxAngularVelocity(std::span<const MotionStep> motion);

// From when on it is at rest [s]: infinity where the last entry still moves, 0 without entries.
double EndOf(std::span<const MotionStep> motion);
double EndOf(std::span<const TurnStep> turns);

// `a` turned about `rotation`, by its length [rad].
Vec3 Turned(const Vec3& a, const Vec3& rotation);

// Times increasing, all finite. Problems stand under `place`.
void ValidateMotion(std::span<const MotionStep> motion, base::Problems& problems);
void ValidateTurns(std::span<const TurnStep> turns, const std::string& place,
                   base::Problems& problems);

// A tapping device: each time its cup is lifted at a constant speed, let fall, and stopped at the
// bottom. `count` taps, one each `interval`, the first at `start`.
struct Taps {
  double start = 0;           // [s], >= 0
  int count = 0;              // >= 0
  double height = 0;          // of the fall [m], > 0
  double interval = 0;        // [s], above the time that lift and fall take
  Vec3 gravity{0, 0, -9.81};  // that the cup falls in [m/s²]
};
double TapDuration(const Taps& taps);  // of one lift and fall [s]
std::vector<MotionStep> TapMotion(const Taps& taps);

}  // namespace talus::engine
