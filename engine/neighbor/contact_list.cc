#include "engine/neighbor/contact_list.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <string>

#include "base/error.h"
#include "engine/neighbor/skin_tuner.h"

namespace talus::engine {

namespace {

// Chunks are small in a small scene, for the threads to share. In a large one they must be larger
// than a layer of the grid's cells, so that forces reach into the next chunk only: what is added
// across chunks costs more than what the second-level cache saves.
constexpr std::int64_t kChunkSize = 1024;
constexpr std::int64_t kLargeChunkSize = 12288;
constexpr std::int64_t kFewChunks = 24;      // until chunks are large
constexpr std::int64_t kChunksTogether = 4;  // two or four threads share them evenly

// Rows and blocks of so many particles stay in the second-level cache while their touching pairs,
// their other pairs, their walls and their motion come one after the other.
constexpr std::int64_t kPanelSize = 1024;

// An overlap of spheres, in radii of the smaller, that no contact law is meant for.
constexpr double kMaxOverlapInRun = 1;

// As far as that a sphere may sink into a wall, in its radii. Between two lists it moves by less
// than the skin, 0.6 radii at most: from a higher place to one as far behind the wall takes more,
// so none goes through unseen.
constexpr double kMaxWallShare = 1 - SkinTuner::kLargestSkin / 2;

// What a step of a chunk takes, in a third of what its particles take each: a touching pair is as
// much again, a listed one that does not touch a third (measured while 700 000 grains are poured).
std::int64_t WorkOf(const Chunk& chunk) {
  return 3 * (chunk.end - chunk.begin) + chunk.counts.pairs + 2 * chunk.counts.touching + 1;
}

std::int64_t RoundUp(std::int64_t count) { return (count + kBlock - 1) / kBlock * kBlock; }

}  // namespace

PanelView Chunk::View(const Panel& panel) {
  return {.begin = panel.begin,
          .end = panel.end,
          .window_end = panel.window_end,
          .fresh = panel.fresh,
          .blocks = blocks.data(),
          .touching = touching.data(),
          .runs = runs.data() + panel.first_run,
          .num_runs = panel.num_runs,
          .forces = forces + 8 * (panel.begin - begin)};
}

// Calls visit(first, second, block, lane) for each touching pair of the chunk; `second` of a wall
// is -1 - wall.
template <class Visitor>
void ContactList::VisitTouching(const Chunk& chunk, Visitor&& visit) {
  for (const PairRun& run : chunk.runs) {
    for (std::int64_t k = 0; k < run.num_pairs; ++k) {
      const std::int64_t at = run.first_block + k / kBlock;
      const int lane = static_cast<int>(k % kBlock);
      if ((chunk.touching[at] >> lane & 1) == 0) continue;
      const PairBlock& block = chunk.blocks[at];
      visit(block.first[lane], run.wall < 0 ? block.second[lane] : -1 - run.wall, block, lane);
    }
  }
}

// Puts the memory of touching pairs aside, under the new numbers of their particles. Seen from the
// other side, springs and moments have the opposite sign. Members of the team may meet at a
// particle; the order of its contacts does not matter, as each is found by its other particle.
void ContactList::SaveContacts(std::span<const std::int32_t> order, std::int64_t old_num,
                               Team& team) {
  AssignWithRoom(new_of_old_, old_num, -1);
  const auto num = static_cast<std::int64_t>(order.size());
  team.ForParts(num, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      new_of_old_[order[k]] = static_cast<std::int32_t>(k);
    }
  });
  const auto renamed = [&](std::int32_t first, std::int32_t second, auto&& use) {
    const std::int32_t a = new_of_old_[first];
    const std::int32_t b = second < 0 ? second : new_of_old_[second];
    if (a < 0 || (second >= 0 && b < 0)) return;
    if (second >= 0 && b < a) {
      use(b, a, -1.0f);
    } else {
      use(a, b, 1.0f);
    }
  };
  const bool alone = team.size() == 1;
  const auto next = [&](std::int64_t& place) {
    return alone ? place++
                 : std::atomic_ref<std::int64_t>(place).fetch_add(1, std::memory_order_relaxed);
  };
  assert(shares_.num_chunks() == static_cast<std::int64_t>(chunks_.size()));
  const auto visit_all = [&](const auto& visit) {
    ForChunks(team, shares_, [&](std::int64_t c) { VisitTouching(chunks_[c], visit); });
  };
  AssignWithRoom(old_start_, num + 1, 0);
  visit_all([&](std::int32_t first, std::int32_t second, const PairBlock&, int) {
    renamed(first, second, [&](std::int32_t a, std::int32_t, float) { next(old_start_[a + 1]); });
  });
  for (std::int64_t i = 0; i < num; ++i) old_start_[i + 1] += old_start_[i];
  old_.resize(old_start_.back());
  visit_all([&](std::int32_t first, std::int32_t second, const PairBlock& block, int lane) {
    renamed(first, second, [&](std::int32_t a, std::int32_t b, float sign) {
      OldContact& contact = old_[next(old_start_[a])];
      contact.second = b;
      for (int c = 0; c < 3; ++c) {
        contact.memory[c] = sign * block.spring[c][lane];
        contact.memory[3 + c] = sign * block.moment[c][lane];
      }
    });
  });
  std::copy_backward(old_start_.begin(), old_start_.end() - 1, old_start_.end());
  old_start_[0] = 0;
}

void ContactList::CutPanels(Chunk& chunk) {
  const std::int64_t num = std::max<std::int64_t>((chunk.end - chunk.begin) / kPanelSize, 1);
  const std::int64_t size = RoundUp((chunk.end - chunk.begin + num - 1) / num);
  chunk.panels.resize(num);
  for (std::int64_t p = 0; p < num; ++p) {
    chunk.panels[p].begin = std::min(chunk.begin + p * size, chunk.end);
    chunk.panels[p].end = std::min(chunk.begin + (p + 1) * size, chunk.end);
  }
}

void ContactList::CutChunks(std::int64_t num_particles) {
  std::int64_t num_chunks = std::clamp<std::int64_t>(num_particles / kChunkSize, 1, kFewChunks);
  num_chunks =
      std::max(num_chunks, std::min<std::int64_t>(num_particles / kLargeChunkSize, kMaxChunks));
  if (num_chunks > 1) {
    num_chunks = (num_chunks + kChunksTogether - 1) / kChunksTogether * kChunksTogether;
  }
  const std::int64_t size = RoundUp((num_particles + num_chunks - 1) / num_chunks);
  chunks_.resize(num_chunks);
  for (std::int64_t c = 0; c < num_chunks; ++c) {
    chunks_[c].begin = std::min(c * size, RoundUp(num_particles));
    chunks_[c].end = std::min((c + 1) * size, RoundUp(num_particles));
    CutPanels(chunks_[c]);
  }
}

void ContactList::ShareChunks(const Team& team) {
  work_.resize(chunks_.size());
  std::transform(chunks_.begin(), chunks_.end(), work_.begin(), WorkOf);
  shares_.Cut(work_, team.size());
}

void ContactList::FindSpheres(const RebuildInput& input, const Panel& panel, Scratch& scratch) {
  const ParticleStore& p = input.particles;
  const std::int64_t num_materials = input.num_materials;
  for (std::int64_t i = panel.begin; i < std::min(panel.end, p.num); ++i) {
    search_.FindLater(input.kernels, p, i, scratch.found);
    const auto add = [&](std::int32_t j, std::vector<Candidate>& to) {
      const auto [a, b] = std::minmax(p.materials[i], p.materials[j]);
      to.push_back(
          {static_cast<std::int32_t>(i), j, static_cast<std::int32_t>(a * num_materials + b)});
    };
    for (const std::int32_t j : scratch.found.touching) {
      const double limit =
          p.Radius(i) + p.Radius(j) - kMaxOverlapInRun * std::min(p.Radius(i), p.Radius(j));
      const Vec3 offset = p.Position(j) - p.Position(i);
      if (!(base::Dot(offset, offset) > limit * limit)) {
        throw base::Error("spheres " + std::to_string(p.ids[i]) + " and " +
                          std::to_string(p.ids[j]) +
                          " overlap by more than the radius of the smaller");
      }
      add(j, scratch.touching);
    }
    for (const std::int32_t j : scratch.found.near) add(j, scratch.near);
  }
}

void ContactList::FindWalls(const RebuildInput& input, const Panel& panel, Scratch& scratch) {
  const ParticleStore& p = input.particles;
  const auto num_materials = static_cast<std::int32_t>(input.num_materials);
  StepView view{};
  view.motion = input.particles.motion.data();
  view.walls = input.walls.views().data();
  scratch.gaps.resize(panel.end - panel.begin);
  for (std::int32_t w = 0; w < input.walls.size(); ++w) {
    if (input.walls.Removed(w)) continue;
    input.kernels.wall_gaps(view, w, panel.begin, panel.end, scratch.gaps.data());
    for (std::int64_t i = panel.begin; i < std::min(panel.end, p.num); ++i) {
      const double gap = scratch.gaps[i - panel.begin];
      if (!(gap < input.reach)) continue;
      if (!(gap > -kMaxWallShare * p.Radius(i))) {
        throw base::Error("sphere " + std::to_string(p.ids[i]) + " goes through " +
                          input.walls.NameOf(w));
      }
      const std::int32_t key = num_materials * (num_materials + w) + p.materials[i];
      (gap < 0 ? scratch.touching : scratch.near)
          .push_back({static_cast<std::int32_t>(i), -1 - w, key});
    }
  }
}

void ContactList::Remember(PairBlock& block, int lane, const Candidate& candidate) const {
  for (std::int64_t k = old_start_[candidate.first]; k < old_start_[candidate.first + 1]; ++k) {
    if (old_[k].second != candidate.second) continue;
    for (int c = 0; c < 3; ++c) {
      block.spring[c][lane] = old_[k].memory[c];
      block.moment[c][lane] = old_[k].memory[3 + c];
    }
  }
}

// Appends one run for each key that occurs to the chunk's, with empty blocks for its pairs, and
// notes where these go.
void ContactList::LayOutRuns(const RebuildInput& input, Chunk& chunk, Panel& panel,
                             Scratch& scratch) {
  const std::int64_t num_materials = input.num_materials;
  const std::int64_t num_keys = num_materials * (num_materials + input.walls.size());
  scratch.count_of_key.assign(num_keys, 0);
  scratch.next_of_key.assign(num_keys, 0);
  for (const auto* list : {&scratch.touching, &scratch.near}) {
    for (const Candidate& candidate : *list) ++scratch.count_of_key[candidate.key];
  }
  panel.first_run = static_cast<std::int64_t>(chunk.runs.size());
  auto num_blocks = static_cast<std::int64_t>(chunk.blocks.size());
  for (std::int64_t key = 0; key < num_keys; ++key) {
    const std::int64_t count = scratch.count_of_key[key];
    if (count == 0) continue;
    const std::int64_t row = key / num_materials, column = key % num_materials;
    const auto wall = static_cast<std::int32_t>(row < num_materials ? -1 : row - num_materials);
    const std::int64_t other = wall < 0 ? row : input.walls.walls()[wall].material;
    chunk.runs.push_back(
        {num_blocks, count, static_cast<std::int32_t>(other * num_materials + column), wall});
    scratch.next_of_key[key] = kBlock * num_blocks;
    num_blocks += (count + kBlock - 1) / kBlock;
  }
  panel.num_runs = static_cast<std::int64_t>(chunk.runs.size()) - panel.first_run;
  PairBlock empty{};
  std::fill(std::begin(empty.first), std::end(empty.first), static_cast<std::int32_t>(panel.begin));
  std::fill(std::begin(empty.second), std::end(empty.second),
            static_cast<std::int32_t>(panel.begin));
  ExtendWithRoom(chunk.blocks, num_blocks, empty);
  ExtendWithRoom(chunk.touching, num_blocks, 0);
}

// In each run the touching pairs first, so that the blocks of the others are passed over.
void ContactList::Fill(const RebuildInput& input, Chunk& chunk, Panel& panel, Scratch& scratch) {
  LayOutRuns(input, chunk, panel, scratch);
  std::int64_t last = panel.end - 1;
  for (const auto* list : {&scratch.touching, &scratch.near}) {
    for (const Candidate& candidate : *list) {
      const std::int64_t place = scratch.next_of_key[candidate.key]++;
      PairBlock& block = chunk.blocks[place / kBlock];
      const int lane = static_cast<int>(place % kBlock);
      block.first[lane] = candidate.first;
      if (candidate.second >= 0) block.second[lane] = candidate.second;
      last = std::max<std::int64_t>(last, candidate.second);
      if (list != &scratch.touching) continue;
      Remember(block, lane, candidate);
      chunk.touching[place / kBlock] |= static_cast<std::uint16_t>(1 << lane);
    }
  }
  panel.window_end = RoundUp(last + 1);
}

void ContactList::Restored(const ListCounts& counts) {
  counts_ = counts;
  for (Chunk& chunk : chunks_) {
    chunk.counts = {};
    for (const PairRun& run : chunk.runs) chunk.counts.pairs += run.num_pairs;
    VisitTouching(chunk, [&](auto&&...) { ++chunk.counts.touching; });
  }
}

// Rows are free again when the last chunk that they reach into has moved. Those of a member's first
// chunks wait for the members before; of the others, so many are in use that a few sets serve in
// turn, which stay in the cache.
void ContactList::AssignRowSets() {
  row_set_.resize(chunks_.size());
  first_of_set_.clear();
  first_of_set_.reserve(chunks_.size());
  for (int member = 0; member < shares_.num_members(); ++member) {
    const auto [begin, end] = shares_.Of(member);
    const std::int64_t moves_from = MovesFrom(member), in_turn = reach_ + 1;
    for (std::int64_t c = begin; c < end; ++c) {
      if (c >= moves_from + in_turn) {
        row_set_[c] = row_set_[c - in_turn];
        continue;
      }
      row_set_[c] = static_cast<std::int64_t>(first_of_set_.size());
      first_of_set_.push_back(c);
    }
  }
}

void ContactList::PrepareForces(Team& team) {
  const auto num_chunks = static_cast<std::int64_t>(chunks_.size());
  std::int64_t num_rows = 0;
  reach_ = 0;
  for (std::int64_t c = 0; c < num_chunks; ++c) {
    num_rows = std::max(num_rows, chunks_[c].window_end - chunks_[c].begin);
    chunks_[c].overhangs.clear();
    chunks_[c].overhangs.reserve(num_chunks);
    for (std::int64_t before = 0; before < c; ++before) {
      if (chunks_[before].window_end > chunks_[c].begin) {
        reach_ = std::max(reach_, c - before);
      }
    }
  }
  ShareChunks(team);
  AssignRowSets();
  // Each member empties the rows that it will use, which also puts them into its own memory.
  const std::int64_t set_size = 8 * num_rows;
  ExtendWithRoom(force_rows_, set_size * static_cast<std::int64_t>(first_of_set_.size()), 0.0);
  ForChunks(team, shares_, [&](std::int64_t c) {
    if (first_of_set_[row_set_[c]] != c) return;
    std::fill_n(force_rows_.data() + set_size * row_set_[c], set_size, 0.0);
  });
  for (std::int64_t c = 0; c < num_chunks; ++c) {
    Chunk& chunk = chunks_[c];
    chunk.forces = force_rows_.data() + set_size * row_set_[c];
    for (std::int64_t before = std::max<std::int64_t>(c - reach_, 0); before < c; ++before) {
      const Chunk& other = chunks_[before];
      if (other.window_end <= chunk.begin) continue;
      chunk.overhangs.push_back(
          {other.forces + 8 * (chunk.begin - other.begin), chunk.begin, other.window_end});
    }
  }
}

void ContactList::Find(const RebuildInput& input, Chunk& chunk, Scratch& scratch) {
  chunk.blocks.clear();
  chunk.touching.clear();
  chunk.runs.clear();
  chunk.counts = {};
  chunk.window_end = chunk.begin;
  for (Panel& panel : chunk.panels) {
    panel.fresh = chunk.window_end;
    scratch.touching.clear();
    scratch.near.clear();
    FindSpheres(input, panel, scratch);
    FindWalls(input, panel, scratch);
    Fill(input, chunk, panel, scratch);
    const auto touching = static_cast<std::int64_t>(scratch.touching.size());
    chunk.counts.pairs += touching + static_cast<std::int64_t>(scratch.near.size());
    chunk.counts.touching += touching;
    chunk.window_end = std::max(chunk.window_end, panel.window_end);
  }
}

// Chunks know nothing of each other here. The error reported is that of the first chunk that has
// one.
void ContactList::FindAll(const RebuildInput& input) {
  const auto num_chunks = static_cast<std::int64_t>(chunks_.size());
  ShareChunks(input.team);  // by what they held at the last rebuild: nearly the same
  scratch_.resize(input.team.size());
  errors_.assign(num_chunks, nullptr);
  input.team.Run([&](int member) {
    const auto [begin, end] = shares_.Of(member);
    for (std::int64_t c = begin; c < end; ++c) {
      try {
        Find(input, chunks_[c], scratch_[member]);
      } catch (...) {  // memory may run out, too, and a task of the team must not throw
        errors_[c] = std::current_exception();
      }
    }
  });
  counts_ = {};
  for (std::int64_t c = 0; c < num_chunks; ++c) {
    if (errors_[c]) std::rethrow_exception(errors_[c]);
    counts_.pairs += chunks_[c].counts.pairs;
    counts_.touching += chunks_[c].counts.touching;
  }
}

void ContactList::Rebuild(const RebuildInput& input, std::span<const std::int32_t> alive) {
  ParticleStore& p = input.particles;
  search_.Sort(p, alive, input.reach, input.team);
  SaveContacts(search_.order(), p.num, input.team);
  p.Reorder(search_.order(), input.team);
  search_.NoteLarge(p);
  CutChunks(p.num);
  FindAll(input);
  PrepareForces(input.team);
}

}  // namespace talus::engine
