#include "experiments/rigs/phased/flow.h"

#include <algorithm>

namespace talus::rigs {
namespace {

// When so much had passed [s]; between two looks it is interpolated.
double TimeOf(double mass, std::span<const Passed> flow) {
  Passed before;
  for (const Passed& now : flow) {
    if (now.mass >= mass) {
      const double share = (mass - before.mass) / std::max(now.mass - before.mass, 1e-300);
      return before.time + share * (now.time - before.time);
    }
    before = now;
  }
  return flow.back().time;
}

}  // namespace

bool HasStopped(std::span<const Passed> flow, double for_time) {
  if (flow.empty()) return false;
  for (auto look = flow.rbegin(); look != flow.rend(); ++look) {
    if (look->mass < flow.back().mass) return false;
    if (flow.back().time - look->time >= for_time) return true;
  }
  return false;
}

bool HasFlowed(double passed, double filled) {
  constexpr double kFlowing = 0.1;  // of the powder
  return passed > kFlowing * filled;
}

double MassLeft(double filled, double passed) {
  const double left = filled - passed;
  return left > 1e-9 * filled ? left : 0;
}

std::vector<Reading> FlowReadings(std::span<const Passed> flow, double passed, bool flows,
                                  const std::string& none) {
  Reading time{Observable::kDischargeTime};
  Reading rate{.observable = Observable::kDischargeRate, .value = 0};
  if (flows && !flow.empty()) {
    time.value = TimeOf(0.95 * passed, flow);
    rate.value = 0.4 * passed / (TimeOf(0.6 * passed, flow) - TimeOf(0.2 * passed, flow));
  } else {
    time.undefined = none;
  }
  return {time, rate};
}

}  // namespace talus::rigs
