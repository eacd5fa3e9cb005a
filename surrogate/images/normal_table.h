// Φ, the normal distribution function, from a table: the innermost loop of every predicted image.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace talus::surrogate {

// Cubic between points 1/32 apart: off by less than 1e-8, and 0 or 1 beyond ±6.
class NormalTable {
 public:
  static double Cdf(double t) {
    static const NormalTable table;
    if (t <= -kEnd) return 0;
    if (t >= kEnd) return 1;
    const double place = (t + kEnd) * kPerUnit;
    const auto i = static_cast<std::size_t>(place);
    const double f = place - static_cast<double>(i);
    const Node& a = table.nodes_[i];
    const Node& b = table.nodes_[i + 1];
    const double jump = b.value - a.value;
    return a.value + f * (a.slope + f * (3 * jump - 2 * a.slope - b.slope +
                                         f * (a.slope + b.slope - 2 * jump)));
  }

 private:
  struct Node {
    double value;
    double slope;  // per table step
  };
  static constexpr double kEnd = 6;
  static constexpr int kPerUnit = 32;

  NormalTable() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const double t = static_cast<double>(i) / kPerUnit - kEnd;
      nodes_[i] = {.value = 0.5 * std::erfc(-t / std::numbers::sqrt2),
                   .slope = std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi) / kPerUnit};
    }
  }
  std::array<Node, static_cast<std::size_t>(2 * 6 * kPerUnit + 2)> nodes_;
};

}  // namespace talus::surrogate
