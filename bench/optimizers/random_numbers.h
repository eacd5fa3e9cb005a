// The benchmark's own random numbers: the same problems as those the peers were measured on, bit
// for bit, whatever the library's generator becomes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "bench/optimizers/problems.h"

namespace talus::bench {

constexpr double kPi = std::numbers::pi;

inline std::uint64_t Mix(std::uint64_t z) {  // splitmix64 finaliser
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}
struct Rng {
  std::uint64_t s;
  bool have = false;
  double spare = 0;
  explicit Rng(std::uint64_t seed) : s(Mix(seed)) {}
  std::uint64_t Next() { return s = Mix(s); }
  double Uniform() { return ((Next() >> 11) + 0.5) * (1.0 / 9007199254740992.0); }
  double Uniform(double a, double b) { return a + (b - a) * Uniform(); }
  double Normal() {
    if (have) {
      have = false;
      return spare;
    }
    double u = Uniform(), v = Uniform(), r = std::sqrt(-2 * std::log(u));
    spare = r * std::sin(2 * kPi * v);
    have = true;
    return r * std::cos(2 * kPi * v);
  }
};
inline std::uint64_t HashString(const std::string& t) {
  std::uint64_t h = 1469598103934665603ULL;
  for (unsigned char c : t) h = (h ^ c) * 1099511628211ULL;
  return h;
}
inline std::uint64_t HashPoint(std::uint64_t h, const Vec& u) {
  for (double v : u)
    h = Mix(h ^ static_cast<std::uint64_t>(static_cast<int64_t>(std::llround(v * 1e10))));
  return h;
}
inline double Clamp01(double v) { return std::min(1.0, std::max(0.0, v)); }

}  // namespace talus::bench
