// Random numbers keyed by what they are for, so that they depend neither on threads nor on order.
//
//   Random(seed, stream, index) is the index-th generator of a stream; its k-th number is
//   mix(key + k φ), SplitMix64 [steele2014], with key = a hash of the three.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace talus::base {

// SplitMix64's finaliser: a bijection of 64 bits that passes for random.
constexpr std::uint64_t Mix64(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t index = 0)
      : state_(Mix64(Mix64(Mix64(seed + kGamma) ^ (stream + kGamma)) ^ (index + kGamma))) {}

  std::uint64_t Next() { return Mix64(state_ += kGamma); }

  // Uniform in (0, 1]: 53 bits; never 0, and 1 once in 2⁵³.
  double Uniform() { return (static_cast<double>(Next() >> 11) + 0.5) * 0x1p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

  // Uniform in {0, …, n-1}; n > 0. The bias, below n / 2⁶⁴, does not matter here.
  std::uint64_t Below(std::uint64_t n) {
    return static_cast<std::uint64_t>((static_cast<__uint128_t>(Next()) * n) >> 64);
  }

  // Standard normal, by Box and Muller.
  double Normal() {
    const double radius = std::sqrt(-2 * std::log(Uniform()));
    return radius * std::cos(2 * std::numbers::pi * Uniform());
  }

 private:
  static constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15ULL;
  std::uint64_t state_;
};

// The stream number of a purpose, so that two purposes never share one: Stream("lhs").
constexpr std::uint64_t Stream(const char* purpose) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  for (; *purpose != '\0'; ++purpose) {
    hash = (hash ^ static_cast<unsigned char>(*purpose)) * 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace talus::base
