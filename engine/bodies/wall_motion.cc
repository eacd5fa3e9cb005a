#include "engine/bodies/wall_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace talus::engine {

namespace {

// Calls visit(entry, from, to) for each entry that holds in a part of [time, time + Δt]. Times
// within a millionth of a step of its ends count as these.
template <class Step, class Visit>
void VisitEntries(std::span<const Step> list, double time, double time_step, Visit&& visit) {
  const double slack = 1e-6 * time_step;
  const double end = time + time_step;
  auto next = std::upper_bound(list.begin(), list.end(), time + slack,
                               [](double t, const Step& step) { return t < step.time; });
  double from = time;
  while (true) {
    const bool last = next == list.end() || next->time >= end - slack;
    const double to = last ? end : next->time;
    if (next != list.begin()) visit(*(next - 1), from, to);
    if (last) return;
    from = to;
    ++next;
  }
}

Vec3 VelocityAt(const MotionStep& step, double time) {
  if (step.acceleration == Vec3()) return step.velocity;
  return step.velocity + (time - step.time) * step.acceleration;
}

}  // namespace

MeanMotion MotionOver(std::span<const MotionStep> motion, double time, double time_step) {
  MeanMotion mean;
  VisitEntries(motion, time, time_step, [&](const MotionStep& step, double from, double to) {
    const double share = (to - from) / (time + time_step - time);  // 1 for the whole step
    mean.velocity += share * VelocityAt(step, (from + to) / 2);
    mean.angular_velocity += share * step.angular_velocity;
  });
  return mean;
}

Vec3 TurnOver(std::span<const TurnStep> turns, double time, double time_step) {
  Vec3 mean;
  VisitEntries(turns, time, time_step, [&](const TurnStep& step, double from, double to) {
    mean += ((to - from) / (time + time_step - time)) * step.angular_velocity;
  });
  return mean;
}

double MaxVelocity(std::span<const MotionStep> motion) {
  double speed = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    speed = std::max(speed, base::Norm(motion[i].velocity));
    if (i + 1 == motion.size()) break;
    speed = std::max(speed, base::Norm(VelocityAt(motion[i], motion[i + 1].time)));
  }
  return speed;
}

double MaxAngularVelocity(std::span<const MotionStep> motion) {
  double speed = 0;
  for (const MotionStep& step : motion) speed = std::max(speed, base::Norm(step.angular_velocity));
  return speed;
}

double EndOf(std::span<const MotionStep> motion) {
  if (motion.empty()) return 0;
  const MotionStep& last = motion.back();
  const bool rests = base::Norm(last.velocity) == 0 && base::Norm(last.acceleration) == 0 &&
                     base::Norm(last.angular_velocity) == 0;
  return rests ? last.time : std::numeric_limits<double>::infinity();
}

double EndOf(std::span<const TurnStep> turns) {
  if (turns.empty()) return 0;
  const bool rests = base::Norm(turns.back().angular_velocity) == 0;
  return rests ? turns.back().time : std::numeric_limits<double>::infinity();
}

// Rodrigues: a cos φ + (k × a) sin φ + k (k·a)(1 − cos φ), with k φ the rotation.
Vec3 Turned(const Vec3& a, const Vec3& rotation) {
  const double angle = base::Norm(rotation);
  if (angle == 0) return a;
  const Vec3 k = rotation / angle;
  const double half = std::sin(angle / 2);
  return std::cos(angle) * a + std::sin(angle) * Cross(k, a) + (2 * half * half * Dot(k, a)) * k;
}

namespace {

template <class Step>
void ValidateTimes(std::span<const Step> list, std::size_t i, const std::string& place,
                   base::Problems& problems) {
  problems.Require(list[i].time >= 0 && list[i].time < 1e100, place + ".time", list[i].time,
                   "must be a finite time, not negative");
  problems.Require(i == 0 || list[i].time > list[i - 1].time, place + ".time", list[i].time,
                   "must be later than the one before");
}

}  // namespace

void ValidateMotion(std::span<const MotionStep> motion, base::Problems& problems) {
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const MotionStep& step = motion[i];
    const std::string place = "motion[" + std::to_string(i) + "]";
    ValidateTimes(motion, i, place, problems);
    problems.Require(base::IsFinite(step.velocity), place + ".velocity", "must be finite");
    problems.Require(base::IsFinite(step.acceleration), place + ".acceleration", "must be finite");
    problems.Require(base::IsFinite(step.angular_velocity), place + ".angular_velocity",
                     "must be finite");
  }
  if (motion.empty()) return;
  problems.Require(motion.back().acceleration == Vec3(),
                   "motion[" + std::to_string(motion.size() - 1) + "].acceleration",
                   "would go on for ever; add an entry that ends it");
}

void ValidateTurns(std::span<const TurnStep> turns, const std::string& place,
                   base::Problems& problems) {
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const std::string item = place + "[" + std::to_string(i) + "]";
    ValidateTimes(turns, i, item, problems);
    problems.Require(base::IsFinite(turns[i].angular_velocity), item + ".angular_velocity",
                     "must be finite");
  }
}

namespace {

double FallTime(const Taps& taps) { return std::sqrt(2 * taps.height / base::Norm(taps.gravity)); }

}  // namespace

// Up as slowly as twice the time of the fall allows.
double TapDuration(const Taps& taps) { return 3 * FallTime(taps); }

std::vector<MotionStep> TapMotion(const Taps& taps) {
  std::vector<MotionStep> motion;
  const double fall = FallTime(taps);
  const Vec3 up = -(taps.height / (2 * fall * base::Norm(taps.gravity))) * taps.gravity;
  for (int k = 0; k < taps.count; ++k) {
    const double start = taps.start + k * taps.interval;
    motion.push_back({.time = start, .velocity = up});
    motion.push_back({.time = start + 2 * fall, .velocity = {}, .acceleration = taps.gravity});
    motion.push_back({.time = start + 3 * fall, .velocity = {}});
  }
  return motion;
}

}  // namespace talus::engine
