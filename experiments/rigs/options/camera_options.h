// A camera that takes a series of pictures while the powder moves.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "base/field.h"
#include "base/problems.h"

namespace talus::rigs {

// What the profile of a series shows: the mean of its pictures, or powder where any of them does.
enum class Shown { kMean, kAny };

struct CameraOptions {
  int frames = 0;       // > 0
  double interval = 0;  // from one to the next [s], > 0
  double start = 0;     // of the first, after the phase that is measured has begun [s], >= 0
  Shown shows = Shown::kMean;
  double closing = 0;  // gaps of powder narrower than this are filled, with kAny [m], >= 0

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
    visit("shows", self.shows,
          {.doc = "what profile.png is: the mean of the pictures, or powder where any shows it"});
    visit("closing", self.closing,
          {.dimension = Dimension::kLength,
           .doc = "with \"shows\": \"any\": gaps between powder narrower than this are filled, as "
                  "grains in flight leave them from picture to picture; >= 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.RequireFromTo("frames", frames, 1, kMostFrames);
    problems.Require(interval > 0 && std::isfinite(interval), "interval", interval,
                     "must be positive: pictures at one time are one picture");
    problems.Require(start >= 0 && std::isfinite(start), "start", start, "must not be negative");
    problems.Require(closing >= 0 && std::isfinite(closing), "closing", closing,
                     "must not be negative");
    problems.Require(closing == 0 || shows == Shown::kAny, "closing", closing,
                     "fills gaps of a picture in black and white: add \"shows\": \"any\"");
  }
};

}  // namespace talus::rigs

template <>
struct talus::base::Names<talus::rigs::Shown> {
  using enum talus::rigs::Shown;
  static constexpr std::array kList{std::pair{"mean", kMean}, std::pair{"any", kAny}};
};
