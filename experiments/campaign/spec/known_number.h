// A measured number as its value and error, whatever its dimension, to be set beside others.
#pragma once

#include <cmath>
#include <optional>

#include "base/student_factor.h"
#include "experiments/campaign/spec/measured_numbers.h"

namespace talus::campaign {

struct KnownNumber {
  double value = 0;  // SI
  double error = 0;  // standard error, SI
};

// So many errors apart two statements of one quantity contradict each other.
inline constexpr double kContradiction = 5;

template <rigs::Observable O>
std::optional<KnownNumber> KnownOf(const MeasuredNumbers& numbers) {
  const auto& number = numbers.Of<O>();
  if (!number) return std::nullopt;
  return KnownNumber{.value = number->Value(),
                     .error = base::NormalError(number->StandardError(), number->Degrees())};
}

// Both numbers are above zero.
inline KnownNumber Ratio(const KnownNumber& above, const KnownNumber& below) {
  const double ratio = above.value / below.value;
  return {.value = ratio,
          .error = ratio * std::hypot(above.error / above.value, below.error / below.value)};
}

}  // namespace talus::campaign
