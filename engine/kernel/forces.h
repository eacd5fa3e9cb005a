// Forces of one panel: eight pairs at a time, all of one run with the same two materials.
//
// Each block is loaded, answered by the law and added to the force rows in an order that follows
// from the list and the positions, so that the sums do not depend on who computes what. Pairs out
// of reach cost the distance test only.
#pragma once

#include "engine/kernel/batch.h"
#include "engine/kernel/shapes.h"
#include "engine/kernel/simd.h"

namespace talus::engine::TALUS_TARGET {

// Parts with more lanes in reach than this are answered where they are.
inline constexpr int kFewLanes = Lanes::kWidth / 2 - 1;

template <class NormalLaw, class RollingLaw>
TALUS_INLINE void SpherePart(const StepView& step, const PanelView& panel,
                             const PairConstants& constants, const Part& part,
                             Batch<NormalLaw, RollingLaw>& batch) {
  const Pairs pairs(step, constants, part.first(), part.second(), part.valid);
  const unsigned active = Bits(pairs.active);
  if (active == 0) return part.Clear();
  if (__builtin_popcount(active) > kFewLanes) {
    SphereForces<NormalLaw, RollingLaw>(step, panel, constants, pairs, part);
    return;
  }
  batch.Add(part, active);
  if (batch.full()) batch.Flush();
}

// `kAny` of all shapes and motions; else of the few shapes that do not turn.
template <class NormalLaw, class RollingLaw, bool kAny>
TALUS_INLINE void WallPart(const StepView& step, const PanelView& panel,
                           const PairConstants& constants, const WallView& wall, const Part& part) {
  const Positions p = LoadPositions(step, part.first());
  const NearestPoint<Lanes> nearest = kAny ? Nearest(wall, p.at) : NearestOfFew(wall, p.at);
  const Lanes overlap = p.radius - nearest.distance;
  const Mask active = part.valid & (overlap > Lanes(-constants.adhesion_gap));
  if (Bits(active) == 0) return part.Clear();

  const Body<Lanes> i = LoadBody(step, part.first(), p.radius);
  const Lanes zero(0.0);
  const Vector<Lanes> none{zero, zero, zero};
  const Body<Lanes> j = kAny ? WallBody(wall, p.at, nearest)
                             : Body<Lanes>{zero, zero, zero, Broadcast<Lanes>(wall.velocity), none};
  const Contact<Lanes> contact =
      MakeContact(nearest.normal, overlap, i.radius, i.radius * i.angular_velocity, i, j);
  const Response<Lanes> on_i =
      Answer<NormalLaw, RollingLaw>(constants, step, contact, active, part);
  AddToRows<false>(on_i.force, i.radius * on_i.lever + on_i.rolling, panel.forces, part.first(),
                   panel.begin);
}

// A part of a run by its place, so that nothing of the caller's has to be in memory.
struct Place {
  const PairRun* run;
  std::int64_t block;
  int lane;
};

TALUS_INLINE Part PartAt(const PanelView& panel, const PairRun& run, std::int64_t b, int lane) {
  const std::int64_t at = run.first_block + b;
  const auto left = static_cast<double>(run.num_pairs - b * kBlock - lane);
  return {panel.blocks[at], panel.touching[at], lane, Lanes::Iota() < Lanes(left)};
}

// Not inlined: scenes without such walls must not pay for them.
template <class NormalLaw, class RollingLaw>
[[gnu::noinline]] void AnyWallPart(const StepView& step, const PanelView& panel, Place place) {
  const PairRun& run = *place.run;
  PairConstants constants = step.constants[run.constants];
  constants.keeps_spring = false;  // between spheres only
  WallPart<NormalLaw, RollingLaw, true>(step, panel, constants, step.walls[run.wall],
                                        PartAt(panel, run, place.block, place.lane));
}

// Asks for what the sweep will come to soon. A panel's pairs reach `window` particles beyond their
// first one, so the rows come up one after the other, as do the blocks.
class Ahead {
 public:
  TALUS_INLINE Ahead(const StepView& step, const PanelView& panel)
      : step_(step), panel_(panel), next_row_(panel.fresh) {}

  TALUS_INLINE void Block(const PairBlock* block) const {
    const auto* line = reinterpret_cast<const char*>(block);
    for (std::size_t at = 0; at < sizeof(PairBlock); at += 64) _mm_prefetch(line + at, _MM_HINT_T0);
  }
  TALUS_INLINE void Rows(std::int64_t first) {
    const std::int64_t wanted = first + (panel_.window_end - panel_.end) + kRowsAhead;
    const std::int64_t last = wanted < panel_.window_end ? wanted : panel_.window_end;
    for (; next_row_ < last; ++next_row_) {
      _mm_prefetch(reinterpret_cast<const char*>(step_.motion + 8 * next_row_), _MM_HINT_T0);
      _mm_prefetch(reinterpret_cast<const char*>(step_.spin + 4 * next_row_), _MM_HINT_T0);
      _mm_prefetch(reinterpret_cast<const char*>(panel_.forces + 8 * (next_row_ - panel_.begin)),
                   _MM_HINT_T0);
    }
  }

 private:
  static constexpr std::int64_t kRowsAhead = 16;
  const StepView& step_;
  const PanelView& panel_;
  std::int64_t next_row_;
};

template <class NormalLaw, class RollingLaw>
void Forces(const StepView& step, const PanelView& panel) {
  Ahead ahead(step, panel);
  for (std::int64_t r = 0; r < panel.num_runs; ++r) {
    const PairRun run = panel.runs[r];
    PairConstants constants = step.constants[run.constants];
    constants.keeps_spring = constants.keeps_spring && run.wall < 0;
    const std::int64_t num_blocks = (run.num_pairs + kBlock - 1) / kBlock;
    Batch<NormalLaw, RollingLaw> batch(step, panel, constants);
    for (std::int64_t b = 0; b < num_blocks; ++b) {
      const std::int64_t at = run.first_block + b;
      ahead.Block(panel.blocks + at + 3);
      ahead.Rows(panel.blocks[at].first[0]);
      for (int lane = 0; lane < kBlock; lane += Lanes::kWidth) {
        const Part part = PartAt(panel, run, b, lane);
        if (run.wall < 0) {
          SpherePart<NormalLaw, RollingLaw>(step, panel, constants, part, batch);
          continue;
        }
        const WallView& wall = step.walls[run.wall];
        if (wall.turns || wall.kind >= ShapeKind::kAnnulus) {
          AnyWallPart<NormalLaw, RollingLaw>(step, panel, {&panel.runs[r], b, lane});
        } else {
          WallPart<NormalLaw, RollingLaw, false>(step, panel, constants, wall, part);
        }
      }
    }
    batch.Flush();
  }
}

}  // namespace talus::engine::TALUS_TARGET
