// A measured number, or the reason why there is none.
#pragma once

#include <limits>
#include <string>
#include <utility>

namespace talus::imaging {

struct Measured {
  double value = std::numeric_limits<double>::quiet_NaN();           // unit as the owner says
  double standard_error = std::numeric_limits<double>::quiet_NaN();  // NaN when nothing tells it
  std::string not_defined;  // "the heap is empty": completes "not defined, because …"

  bool defined() const { return not_defined.empty(); }
};

inline Measured Defined(double value) {
  Measured measured;
  measured.value = value;
  return measured;
}
inline Measured NotDefined(std::string because) {
  Measured measured;
  measured.not_defined = std::move(because);
  return measured;
}

}  // namespace talus::imaging
