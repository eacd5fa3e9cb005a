#include "engine/threads/work_shares.h"

#include <numeric>

namespace talus::engine {

// A chunk goes to the member in whose part of the work its middle lies.
void WorkShares::Cut(std::span<const std::int64_t> work, int num_members) {
  const std::int64_t total = std::accumulate(work.begin(), work.end(), std::int64_t{0});
  const auto num_chunks = static_cast<std::int64_t>(work.size());
  cuts_.assign(num_members + 1, num_chunks);
  std::int64_t chunk = 0, before = 0;
  for (int member = 0; member < num_members; ++member) {
    cuts_[member] = chunk;
    const std::int64_t until = 2 * total * (member + 1) / num_members;
    for (; chunk < num_chunks && 2 * before + work[chunk] < until; ++chunk) before += work[chunk];
  }
}

}  // namespace talus::engine
