// A measured number, or the reason why there is none.
#pragma once

#include <span>
#include <string>

#include "base/not_known.h"

namespace talus::imaging {

struct Measured {
  double value = base::kNotKnown;           // unit as the owner says
  double standard_error = base::kNotKnown;  // NaN when nothing tells it
  std::string not_defined{};  // "the heap is empty": completes "not defined, because …"

  bool defined() const { return not_defined.empty(); }
};

// s / √n of the values; NaN for fewer than two.
double StandardError(std::span<const double> values);

}  // namespace talus::imaging
