// Prime numbers, which another program wants for its seeds.
#pragma once

#include <cstdint>

namespace talus::base {

// The least prime that is `least` or more. By trial division: below 10⁹ in some microseconds.
inline std::uint64_t PrimeFrom(std::uint64_t least) {
  const auto is_prime = [](std::uint64_t n) {
    for (std::uint64_t d = 2; d * d <= n; ++d) {
      if (n % d == 0) return false;
    }
    return n > 1;
  };
  while (!is_prime(least)) ++least;
  return least;
}

}  // namespace talus::base
