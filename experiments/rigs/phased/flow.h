// What has run out of a vessel over time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/field.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::rigs {

// What had passed the opening at a look.
struct Passed {
  double time = 0;  // since it was opened [s]
  double mass = 0;  // [kg]

  static constexpr base::FieldKey kKeys[] = {{"time", "time_s"}, {"mass", "mass_kg"}};
  TALUS_FIELDS(time, mass);
};

struct FlowMemory {
  std::vector<Passed> flow{};

  TALUS_FIELDS(flow);
};

// Whether nothing has passed for so long [s]: where little runs out of much, the rest of it rests.
bool HasStopped(std::span<const Passed> flow, double for_time);

// Whether more than a tenth of what was `filled` [kg] has run out: else an arch stands.
bool HasFlowed(double passed, double filled);

// What has not [kg]; 0 where the sums differ by their rounding only.
double MassLeft(double filled, double passed);

// Until 95 % of `passed` [kg] had run out, and the mean rate between 20 and 60 % of it; unless it
// `flows` the rate is 0, and the time has no value, `none` for a reason.
std::vector<Reading> FlowReadings(std::span<const Passed> flow, double passed, bool flows,
                                  const std::string& none);

}  // namespace talus::rigs
