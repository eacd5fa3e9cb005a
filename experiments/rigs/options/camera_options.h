// A camera that takes a series of pictures while the powder moves.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/problems.h"

namespace talus::rigs {

// What the profile of a series shows: the mean of its pictures, or powder where any of them does.
enum class Shown { kMean, kAny };

// All times are after the phase that is measured has begun. With `times` the run is filmed: a
// series begins at each of them, and gives a picture of its own.
struct CameraOptions {
  int frames = 1;       // of a series, > 0
  double interval = 0;  // from one to the next [s], > 0; of one frame there is none
  double start = 0;     // of the series, without `times` [s], >= 0
  std::optional<std::vector<double>> times{};  // [s], >= 0, ascending
  Shown shows = Shown::kMean;
  double closing = 0;  // gaps of powder narrower than this are filled, with kAny [m], >= 0

  static constexpr int kMostFrames = 10000;
  static constexpr std::size_t kMostTimes = 16;

  int num_pictures() const { return times ? static_cast<int>(times->size()) : 1; }
  int num_frames() const { return frames * num_pictures(); }  // of all pictures
  // When the series of a picture begins, from 0; and the first and last frame of all [s].
  double BeginOf(int picture) const {
    return times ? (*times)[static_cast<std::size_t>(picture)] : start;
  }
  double FirstTime() const { return BeginOf(0); }
  double LastTime() const { return BeginOf(num_pictures() - 1) + (frames - 1) * interval; }

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("frames", self.frames,
          {.doc = "number of pictures that the profile is the mean of, > 0; at each of `times`"});
    visit("interval", self.interval,
          {.dimension = Dimension::kTime, .doc = "from one picture to the next, > 0"});
    visit("start", self.start,
          {.dimension = Dimension::kTime,
           .doc = "of the first picture, after the phase that is measured has begun, >= 0"});
    visit("times", self.times,
          {.dimension = Dimension::kTime,
           .doc = "a film, instead of `start`: a picture at each of these times after the phase "
                  "that is measured has begun, >= 0 and ascending, sixteen at most; all are of one "
                  "experiment"});
    visit("shows", self.shows,
          {.doc = "what profile.png is: the mean of the pictures, or powder where any shows it"});
    visit("closing", self.closing,
          {.dimension = Dimension::kLength,
           .doc = "with \"shows\": \"any\": gaps between powder narrower than this are filled, as "
                  "grains in flight leave them from picture to picture; >= 0"});
  }
  void Validate(base::Problems& problems) const {
    problems.RequireFromTo("frames", frames, 1, kMostFrames);
    problems.Require(frames == 1 || (interval > 0 && std::isfinite(interval)), "interval", interval,
                     "must be given and positive: pictures at one time are one picture");
    problems.Require(frames != 1 || interval == 0, "interval", interval,
                     "is between several pictures: give frames, or leave it out");
    ValidateTimes(problems);
    problems.Require(start >= 0 && std::isfinite(start), "start", start, "must not be negative");
    problems.Require(closing >= 0 && std::isfinite(closing), "closing", closing,
                     "must not be negative");
    problems.Require(closing == 0 || shows == Shown::kAny, "closing", closing,
                     "fills gaps of a picture in black and white: add \"shows\": \"any\"");
  }

 private:
  void ValidateTimes(base::Problems& problems) const {
    if (!times) return;
    problems.Require(start == 0, "start", start, "stands beside times: leave it out");
    problems.Require(!times->empty() && times->size() <= kMostTimes, "times",
                     static_cast<double>(times->size()), "times, must be from 1 to 16");
    for (std::size_t i = 0; i < times->size(); ++i) {
      const std::string place = "times[" + std::to_string(i) + "]";
      const double time = (*times)[i];
      problems.Require(time >= 0 && std::isfinite(time), place, time, "must not be negative");
      if (i == 0) continue;
      const double gap = time - (*times)[i - 1];
      problems.Require(gap > 0, place, time, "must be after the one before");
      problems.Require(!(gap > 0) || gap > (frames - 1) * interval, place, time,
                       "is before the last of the frames of the time before, which overlap it: "
                       "take fewer frames, a shorter interval, or times farther apart");
    }
  }
};

}  // namespace talus::rigs

template <>
struct talus::base::Names<talus::rigs::Shown> {
  using enum talus::rigs::Shown;
  static constexpr std::array kList{std::pair{"mean", kMean}, std::pair{"any", kAny}};
};
