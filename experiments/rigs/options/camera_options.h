// A camera that takes a series of pictures while the powder moves.
#pragma once

#include <cmath>

#include "base/field.h"
#include "base/problems.h"

namespace talus::rigs {

struct CameraOptions {
  int frames = 0;       // > 0
  double interval = 0;  // from one to the next [s], > 0
  double start = 0;     // of the first, after the phase that is measured has begun [s], >= 0

  static constexpr int kMostFrames = 10000;

  // When the last is taken, after the phase has begun [s].
  double LastTime() const { return start + (frames - 1) * interval; }

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("frames", self.frames, {.required = true, .doc = "number of pictures, > 0"});
    visit("interval", self.interval,
          {.dimension = Dimension::kTime,
           .required = true,
           .doc = "from one picture to the next, > 0"});
    visit("start", self.start,
          {.dimension = Dimension::kTime,
           .doc = "of the first picture, after the phase that is measured has begun, >= 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.RequireFromTo("frames", frames, 1, kMostFrames);
    problems.Require(interval > 0 && std::isfinite(interval), "interval", interval,
                     "must be positive: pictures at one time are one picture");
    problems.Require(start >= 0 && std::isfinite(start), "start", start, "must not be negative");
  }
};

}  // namespace talus::rigs
