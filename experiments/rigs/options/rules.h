// When each phase of a heap test ends.
#pragma once

#include <optional>

#include "base/field.h"
#include "base/problems.h"
#include "engine/overlap_check.h"

namespace talus::rigs {

// When a phase ends: at rest, or at the cap, which the result then says.
struct RestRule {
  double energy_fraction = 1e-4;  // mean kinetic energy of the others / (m g d) [-], > 0
  double moving_share = 0.005;  // of the weight, fastest first, that may still move [-], in [0, 1)
  double hold_time = 0.01;      // that it must stay below for [s], > 0
  double max_time = 1;          // cap of the phase [s], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("energy_fraction", self.energy_fraction,
          {.doc = "at rest below this mean kinetic energy of a grain over m g d, > 0"});
    visit("moving_share", self.moving_share,
          {.doc = "share of the weight, fastest grains first, that this leaves out, in [0, 1)"});
    visit("hold_time", self.hold_time,
          {.dimension = base::Dimension::kTime, .doc = "that it must stay below for, > 0"});
    visit("max_time", self.max_time,
          {.dimension = base::Dimension::kTime, .doc = "the phase ends here at the latest, > 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.RequirePositive("energy_fraction", energy_fraction);
    problems.Require(moving_share >= 0 && moving_share < 1, "moving_share", moving_share,
                     "must be in [0, 1)");
    problems.RequirePositive("hold_time", hold_time);
    problems.RequirePositive("max_time", max_time);
    problems.Require(!(hold_time > max_time), "hold_time", hold_time, "must not exceed max_time");
  }
};

struct PhaseRules {
  double fill_max_overlap = 0.001;  // the filling ends when no overlap/radius is above [-], > 0
  int fill_max_sweeps = 1000;       // cap of the filling [-], > 0
  RestRule settling;                // in the tube
  std::optional<double> lift_max_time{};  // [s]; default: until twice the filled height is lifted
  RestRule heap;                          // after the tube has cleared the heap
  double leave_depth = 5;                 // below the plate, in largest diameters [-], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("fill_max_overlap", self.fill_max_overlap,
          {.doc = "the filling ends when no overlap over radius is above this, > 0"});
    visit("fill_max_sweeps", self.fill_max_sweeps,
          {.doc = "relaxation sweeps of the filling at most, > 0"});
    visit("settling", self.settling, {.doc = "end of the settling in the tube"});
    visit("lift_max_time", self.lift_max_time,
          {.dimension = base::Dimension::kTime,
           .doc = "the lifting ends here at the latest; default: when twice the filled height is "
                  "lifted"});
    visit("heap", self.heap, {.doc = "end of the run, after the tube has cleared the heap"});
    visit("leave_depth", self.leave_depth,
          {.doc = "grains this many largest diameters below the plate leave the scene, > 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.Require(fill_max_overlap > 0 && fill_max_overlap <= engine::kMaxOverlapAtStart,
                     "fill_max_overlap", fill_max_overlap, "must be in (0, 0.25]");
    problems.RequirePositive("fill_max_sweeps", fill_max_sweeps);
    problems.RequirePositive("leave_depth", leave_depth);
    problems.RequirePositive("lift_max_time", lift_max_time);
  }
};

}  // namespace talus::rigs
