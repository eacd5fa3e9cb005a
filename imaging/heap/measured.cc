#include "imaging/heap/measured.h"

#include <cmath>

#include "base/not_known.h"

namespace talus::imaging {

double StandardError(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  if (values.size() < 2) return base::kNotKnown;
  double mean = 0;
  for (const double value : values) mean += value / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (n - 1) / n);
}

}  // namespace talus::imaging
