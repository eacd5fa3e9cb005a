// The scale that a parameter is searched on: the map between its value and a coordinate of the unit
// cube.
//
//   linear   value = low + u (high - low)
//   log      value = low (high / low)^u
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "base/field.h"

namespace talus::optimizer {

enum class Scale { kLinear, kLog };

struct ScaledRange {
  double low = 0;
  double high = 1;  // > low, and low > 0 on a log scale
  Scale scale = Scale::kLinear;

  double ToNative(double unit) const {
    return scale == Scale::kLog ? low * std::pow(high / low, unit) : low + unit * (high - low);
  }
  double ToUnit(double native) const {
    return scale == Scale::kLog ? std::log(native / low) / std::log(high / low)
                                : (native - low) / (high - low);
  }
  // d value / d u
  double Slope(double unit) const {
    return scale == Scale::kLog ? ToNative(unit) * std::log(high / low) : high - low;
  }
};

}  // namespace talus::optimizer

template <>
struct talus::base::Names<talus::optimizer::Scale> {
  static constexpr std::array kList{std::pair{"linear", talus::optimizer::Scale::kLinear},
                                    std::pair{"log", talus::optimizer::Scale::kLog}};
};
