// The neighbour list: pairs of spheres, and of spheres and walls, that are near, in blocks for the
// kernels, with what the touching ones remember.
//
// The particles are cut into chunks, whose number depends on that of the particles only. A pair
// belongs to the chunk of its first particle; its second one is always a later particle, in the
// same chunk or in the overhang of the chunk's force rows. So chunks can be computed at once, and
// every sum has one order. A large chunk is computed in panels, one after the other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <span>
#include <vector>

#include "engine/bodies/aligned.h"
#include "engine/bodies/particle_store.h"
#include "engine/bodies/wall_set.h"
#include "engine/kernel/kernel.h"
#include "engine/neighbor/pair_search.h"
#include "engine/threads/team.h"
#include "engine/threads/work_shares.h"

namespace talus::engine {

inline constexpr int kMaxChunks = 128;

struct ListCounts {
  std::int64_t pairs = 0;     // listed
  std::int64_t touching = 0;  // of them, when the list was made
};

// A part of a chunk so small that its rows stay in the cache until it moves.
struct Panel {
  std::int64_t begin = 0, end = 0, window_end = 0, fresh = 0;  // see PanelView
  std::int64_t first_run = 0, num_runs = 0;
};

struct Chunk {
  std::int64_t begin = 0, end = 0, window_end = 0;  // as of a panel
  std::vector<Panel> panels;
  AlignedVector<PairBlock> blocks;
  std::vector<std::uint16_t> touching;
  std::vector<PairRun> runs;
  double* forces = nullptr;         // rows of [begin, window_end), zero between two steps
  std::vector<Overhang> overhangs;  // of the chunks before
  ListCounts counts;
  MotionCheck check{0, true};  // of the last step

  PanelView View(const Panel& panel);
};

// What a rebuild needs besides the list itself.
struct RebuildInput {
  const KernelTable& kernels;
  ParticleStore& particles;
  const WallSet& walls;
  double reach = 0;                // pairs with a smaller gap are listed [m]
  std::int64_t num_materials = 1;  // PairConstants of materials a, b stand at a · num_materials + b
  Team& team;
};

class ContactList {
 public:
  // Sorts the particles `alive`, drops the others, and lists what is near. Contacts that touched at
  // the last evaluation of the forces keep what they remember. Throws base::Error when two spheres
  // or a sphere and a wall overlap so much that the run is meaningless.
  void Rebuild(const RebuildInput& input, std::span<const std::int32_t> alive);

  std::vector<Chunk>& chunks() { return chunks_; }
  const std::vector<Chunk>& chunks() const { return chunks_; }
  ListCounts counts() const { return counts_; }

  // Which chunks each member of the team has.
  const WorkShares& shares() const { return shares_; }

  // The chunks have been read from a checkpoint, with the counts of their list. What each of them
  // holds is counted, so that members have equal work from the first step on.
  void Restored(const ListCounts& counts);

  // The first chunk of a member that moves as soon as its pairs are done: no chunk of the members
  // before reaches into it. A member must do its chunks in their order, since they share force
  // rows.
  std::int64_t MovesFrom(int member) const {
    const auto [begin, end] = shares_.Of(member);
    return member == 0 ? begin : std::min(begin + reach_, end);
  }

  // Force rows and overhangs of the chunks as they are now.
  void PrepareForces(Team& team);

 private:
  struct OldContact {
    std::int32_t second;  // new index, or -1 - wall
    float memory[6];      // spring and moment
  };
  struct Candidate {
    std::int32_t first;
    std::int32_t second;  // particle, or -1 - wall
    std::int32_t key;     // run it belongs to
  };
  struct Scratch {
    NearSpheres found;  // of one particle
    std::vector<Candidate> touching, near;
    std::vector<double> gaps;
    std::vector<std::int64_t> count_of_key, next_of_key;
  };

  template <class Visitor>
  static void VisitTouching(const Chunk& chunk, Visitor&& visit);
  void SaveContacts(std::span<const std::int32_t> order, std::int64_t old_num, Team& team);
  static void CutPanels(Chunk& chunk);
  void CutChunks(std::int64_t num_particles);
  void ShareChunks(const Team& team);
  void AssignRowSets();
  void FindAll(const RebuildInput& input);
  void Find(const RebuildInput& input, Chunk& chunk, Scratch& scratch);
  void FindSpheres(const RebuildInput& input, const Panel& panel, Scratch& scratch);
  void FindWalls(const RebuildInput& input, const Panel& panel, Scratch& scratch);
  static void LayOutRuns(const RebuildInput& input, Chunk& chunk, Panel& panel, Scratch& scratch);
  void Fill(const RebuildInput& input, Chunk& chunk, Panel& panel, Scratch& scratch);
  void Remember(PairBlock& block, int lane, const Candidate& candidate) const;

  PairSearch search_;
  std::vector<Chunk> chunks_;
  std::vector<std::int64_t> work_;  // of each chunk, see WorkOf
  WorkShares shares_;
  ListCounts counts_;
  std::vector<std::int32_t> new_of_old_;
  std::vector<std::int64_t> old_start_;  // of each particle's contacts in old_
  std::vector<OldContact> old_;
  std::vector<Scratch> scratch_;
  AlignedVector<double> force_rows_;
  std::vector<std::int64_t> row_set_;       // of each chunk, in force_rows_
  std::vector<std::int64_t> first_of_set_;  // the first chunk that has each set
  std::int64_t reach_ = 0;  // how many chunks after its own a chunk's pairs reach into
  std::vector<std::exception_ptr> errors_;  // of each chunk
};

}  // namespace talus::engine
