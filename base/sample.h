// Mean and scatter of repeated values.
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "base/not_known.h"

namespace talus::base {

struct Sample {
  int count = 0;
  double mean = kNotKnown;
  double variance = kNotKnown;  // of one, unbiased; NaN below two

  double Sd() const { return std::sqrt(variance); }
  double StandardError() const { return std::sqrt(variance / count); }  // of the mean
};

inline Sample SampleOf(const std::vector<double>& values) {
  Sample sample{.count = static_cast<int>(values.size())};
  if (values.empty()) return sample;
  sample.mean = std::accumulate(values.begin(), values.end(), 0.0) / sample.count;
  if (sample.count < 2) return sample;
  double squares = 0;
  for (const double v : values) squares += (v - sample.mean) * (v - sample.mean);
  sample.variance = squares / (sample.count - 1);
  return sample;
}

// Scatter within groups, whose means may differ: what a few values of each tell of all.
struct PooledScatter {
  double squares = 0;  // of the deviations from their group's mean
  int degrees = 0;     // of freedom

  void Add(const Sample& group) {
    if (group.count < 2) return;
    degrees += group.count - 1;
    squares += (group.count - 1) * group.variance;
  }
  // Standard error of the mean of so many; NaN where no group has two values.
  double StandardError(int count) const {
    return degrees == 0 ? kNotKnown : std::sqrt(squares / degrees / count);
  }
};

}  // namespace talus::base
