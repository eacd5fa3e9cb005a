// What has run out of a vessel over time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/rigs/observables/observable.h"

namespace talus::rigs {

// What had passed the opening at a look.
struct Passed {
  double time = 0;  // since it was opened [s]
  double mass = 0;  // [kg]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("time_s", self.time);
    visit("mass_kg", self.mass);
  }
};

struct FlowMemory {
  std::vector<Passed> flow{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("flow", self.flow);
  }
};

// Until 95 % of `passed` [kg] had run out, and the mean rate between 20 and 60 % of it; without a
// value, and `none` for a reason, where nothing has.
std::vector<Reading> FlowReadings(std::span<const Passed> flow, double passed,
                                  const std::string& none);

}  // namespace talus::rigs
