#include <array>

#include "base/random.h"
#include "optimizer/designs/design.h"

namespace talus::optimizer {
namespace {

constexpr int kBits = 32;

// A primitive polynomial of degree s with inner coefficients a, and the first s odd numbers m.
struct Direction {
  int s;
  unsigned a;
  std::array<std::uint32_t, 5> m;
};

// new-joe-kuo-6.21201, dimensions 2 to 12 [joe2008].
constexpr std::array kJoeKuo{
    Direction{1, 0, {1}},
    Direction{2, 1, {1, 3}},
    Direction{3, 1, {1, 3, 1}},
    Direction{3, 2, {1, 1, 1}},
    Direction{4, 1, {1, 1, 3, 3}},
    Direction{4, 4, {1, 3, 5, 13}},
    Direction{5, 2, {1, 1, 5, 5, 17}},
    Direction{5, 4, {1, 1, 5, 5, 5}},
    Direction{5, 7, {1, 1, 7, 11, 19}},
    Direction{5, 11, {1, 1, 5, 1, 1}},
    Direction{5, 13, {1, 1, 1, 3, 11}},
};

std::array<std::uint32_t, kBits> DirectionNumbers(int dimension) {
  std::array<std::uint32_t, kBits> v{};
  if (dimension == 0) {
    for (int i = 0; i < kBits; ++i) v[static_cast<std::size_t>(i)] = 1u << (kBits - 1 - i);
    return v;
  }
  const Direction& d = kJoeKuo.at(static_cast<std::size_t>(dimension - 1));
  const auto s = static_cast<std::size_t>(d.s);
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (i < s) {
      v[i] = d.m[i] << (kBits - 1 - i);
      continue;
    }
    v[i] = v[i - s] ^ (v[i - s] >> s);
    for (std::size_t k = 1; k < s; ++k) {
      if ((d.a >> (s - 1 - k)) & 1u) v[i] ^= v[i - k];
    }
  }
  return v;
}

}  // namespace

Points Sobol(int num_points, int num_parameters, std::uint64_t seed) {
  base::Random random(seed, base::Stream("sobol"));
  Points points(static_cast<std::size_t>(num_points), Eigen::VectorXd(num_parameters));
  for (int i = 0; i < num_parameters; ++i) {
    const auto direction = DirectionNumbers(i);
    const auto flip = seed == 0 ? 0u : static_cast<std::uint32_t>(random.Next());
    for (std::size_t n = 0; n < points.size(); ++n) {
      const std::uint64_t gray = n ^ (n >> 1);
      std::uint32_t bits = flip;
      for (std::size_t b = 0; b < direction.size(); ++b) {
        if ((gray >> b) & 1u) bits ^= direction[b];
      }
      points[n][i] = (bits + (seed == 0 ? 0.0 : 0.5)) * 0x1p-32;
    }
  }
  return points;
}

}  // namespace talus::optimizer
