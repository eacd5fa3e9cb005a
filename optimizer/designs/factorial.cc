#include <cmath>
#include <set>

#include "optimizer/designs/design.h"

namespace talus::optimizer {
namespace {

// Coordinates in whole half steps, so that equal points compare equal.
using HalfSteps = std::vector<int>;

int LastHalfStep(int levels) { return 2 * (levels - 1); }

Eigen::VectorXd ToPoint(const HalfSteps& half_steps, std::span<const int> levels) {
  Eigen::VectorXd point(static_cast<Eigen::Index>(levels.size()));
  for (std::size_t i = 0; i < levels.size(); ++i) {
    point[static_cast<Eigen::Index>(i)] =
        levels[i] == 1 ? 0.5 : static_cast<double>(half_steps[i]) / LastHalfStep(levels[i]);
  }
  return point;
}

HalfSteps ToHalfSteps(const Eigen::VectorXd& point, std::span<const int> levels) {
  HalfSteps half_steps;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    half_steps.push_back(static_cast<int>(
        std::lround(point[static_cast<Eigen::Index>(i)] * LastHalfStep(levels[i]))));
  }
  return half_steps;
}

// Counts `digits` up, the last one fastest, each from low to high; false after the last.
bool Advance(std::vector<int>& digits, std::span<const int> low, std::span<const int> high) {
  for (std::size_t i = digits.size(); i-- > 0;) {
    if (digits[i] < high[i]) {
      ++digits[i];
      return true;
    }
    digits[i] = low[i];
  }
  return false;
}

}  // namespace

Points FullFactorial(std::span<const int> levels) {
  const std::vector<int> low(levels.size(), 0);
  std::vector<int> high(levels.begin(), levels.end());
  for (int& h : high) --h;
  std::vector<int> digits = low;
  Points points;
  do {
    HalfSteps half_steps = digits;
    for (int& h : half_steps) h *= 2;
    points.push_back(ToPoint(half_steps, levels));
  } while (Advance(digits, low, high));
  return points;
}

Points HalfStepNeighbours(std::span<const int> levels, std::span<const Eigen::VectorXd> centers) {
  const std::vector<int> low(levels.size(), -1);
  const std::vector<int> high(levels.size(), 1);
  std::set<HalfSteps> seen;
  Points points;
  for (const Eigen::VectorXd& center : centers) {
    const HalfSteps base = ToHalfSteps(center, levels);
    std::vector<int> offset = low;
    do {
      HalfSteps moved = base;
      bool inside = true;
      for (std::size_t i = 0; i < levels.size(); ++i) {
        moved[i] += offset[i];
        inside = inside && moved[i] >= 0 && moved[i] <= LastHalfStep(levels[i]);
      }
      if (inside && moved != base && seen.insert(moved).second) {
        points.push_back(ToPoint(moved, levels));
      }
    } while (Advance(offset, low, high));
  }
  return points;
}

}  // namespace talus::optimizer
