// Φ, the normal distribution function, from a table: the innermost loop of every predicted image.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace talus::surrogate {

// Cubic between points 1/32 apart: off by less than 1e-8, and 0 or 1 beyond ±6.
class NormalTable {
 public:
  // The one table there is; a loop asks for it once.
  static const NormalTable& Get() {
    static const NormalTable table;
    return table;
  }
  static double Cdf(double t) { return Get()(t); }

  double operator()(double t) const {
    const double place = std::min(std::max((t + kEnd) * kPerUnit, 0.0), 1.0 * kNumSteps);
    const auto i = static_cast<int>(place);  // a long would cost more to turn back
    const Cubic& c = cubics_[static_cast<std::size_t>(i)];
    const double f = place - i;
    return c.c0 + f * (c.c1 + f * (c.c2 + f * c.c3));
  }

 private:
  static constexpr double kEnd = 6;
  static constexpr int kPerUnit = 32;
  static constexpr int kNumSteps = 2 * 6 * kPerUnit;

  // Φ from one point to the next, f in [0, 1): Hermite's, with Φ and φ at both.
  struct Cubic {
    double c0 = 0;
    double c1 = 0;
    double c2 = 0;
    double c3 = 0;
  };

  NormalTable() {
    const auto at = [](int i) { return static_cast<double>(i) / kPerUnit - kEnd; };
    const auto value = [&](int i) { return 0.5 * std::erfc(-at(i) / std::numbers::sqrt2); };
    const auto slope = [&](int i) {
      return std::exp(-at(i) * at(i) / 2) / std::sqrt(2 * std::numbers::pi) / kPerUnit;
    };
    for (int i = 1; i < kNumSteps; ++i) {
      const double jump = value(i + 1) - value(i);
      cubics_[static_cast<std::size_t>(i)] = {.c0 = value(i),
                                              .c1 = slope(i),
                                              .c2 = 3 * jump - 2 * slope(i) - slope(i + 1),
                                              .c3 = slope(i) + slope(i + 1) - 2 * jump};
    }
    cubics_.back() = {.c0 = 1};  // the first is 0
  }
  std::array<Cubic, static_cast<std::size_t>(kNumSteps + 1)> cubics_;
};

}  // namespace talus::surrogate
