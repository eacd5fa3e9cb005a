// Mean and scatter of repeated values.
#pragma once

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace talus::base {

struct Sample {
  int count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double variance = std::numeric_limits<double>::quiet_NaN();  // of one, unbiased; NaN below two

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

}  // namespace talus::base
