// Chunks in a row, shared among the members of a team so that all have about as much work: in a
// pour the chunks below hold packed grains, and those above hold grains that fall past each other.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/threads/team.h"

namespace talus::engine {

class WorkShares {
 public:
  // work[c] > 0: of chunk c, in any unit. Nothing depends on it but time.
  void Cut(std::span<const std::int64_t> work, int num_members);

  Share Of(int member) const {
    assert(member >= 0 && member < num_members());
    return {cuts_[member], cuts_[member + 1]};
  }
  int num_members() const { return std::max(static_cast<int>(cuts_.size()) - 1, 0); }
  std::int64_t num_chunks() const { return cuts_.empty() ? 0 : cuts_.back(); }

 private:
  std::vector<std::int64_t>
      cuts_;  // where each member's chunks begin, and where the last one's end
};

// Calls visit(c) of all chunks, each member its own; the shares were cut for this team. Few chunks
// are not worth waking anybody.
template <class Visit>
void ForChunks(Team& team, const WorkShares& shares, const Visit& visit) {
  constexpr std::int64_t kWorthSharing = 24;
  const auto visit_all = [&](const Share& share) {
    for (std::int64_t c = share.begin; c < share.end; ++c) visit(c);
  };
  if (shares.num_chunks() < kWorthSharing) return visit_all({0, shares.num_chunks()});
  assert(shares.num_members() == team.size());
  team.Run([&](int member) { visit_all(shares.Of(member)); });
}

}  // namespace talus::engine
