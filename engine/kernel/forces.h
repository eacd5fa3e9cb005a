// Forces of one panel: sixteen pairs at a time, all of one run with the same two materials.
//
// Each block is loaded, answered by the law and added to the force rows in an order that follows
// from the list and the positions, so that the sums do not depend on who computes what. Pairs out
// of reach cost the distance test only.
#pragma once

#include <cstddef>

#include "engine/kernel/batch.h"
#include "engine/kernel/shapes.h"
#include "engine/kernel/simd.h"

namespace talus::engine::TALUS_TARGET {

// Parts with more lanes touching than this are answered where they are.
inline constexpr int kFewLanes = Floats::kWidth / 2 - 1;

// The lanes that may be in reach, and more only by what single precision loses of the places: two
// roundings of each coordinate, less than 2⁻²³ of it and of the distance.
TALUS_INLINE FloatMask MayBeClose(const StepView& step, const SingleConstants& constants,
                                  const Part& part) {
  const FloatQuads i = LoadSpots(step.spot, part.first());
  const FloatQuads j = LoadSpots(step.spot, part.second());
  const Vector<Floats> offset{j.x - i.x, j.y - i.y, j.z - i.z};
  const Floats radii = i.w + j.w + Floats(constants.adhesion_gap);
  const Floats lost = Floats(0x1p-20f) * (Abs(i.x) + Abs(i.y) + Abs(i.z) + radii);
  const Floats reach = radii + lost;
  return part.valid & (Dot(offset, offset) < reach * reach);
}

template <class Law>
TALUS_INLINE void SpherePart(const StepView& step, const PanelView& panel,
                             const KernelConstants& constants, const Part& part,
                             Batch<Law>& batch) {
  const unsigned touching = (part.touching >> part.lane) & part.mask();
  if (__builtin_popcount(touching) > kFewLanes) {
    const Pairs pairs =
        LoadPairs(step, constants.adhesion_gap, part.first(), part.second(), part.valid);
    SphereForces<Law>(step, panel, constants.law, pairs, part);
    return;
  }
  const unsigned close = Bits(MayBeClose(step, constants.law, part));
  if (close == 0) return part.Clear();
  batch.Add(part, close);
  if (batch.full()) batch.Flush();
}

// Where a wall is nearest to each sphere.
struct Nearby {
  Positions sphere;
  NearestPoint<Lanes> nearest;
  Vector<Lanes> velocity;  // of the wall there
  Lanes overlap;
  Mask reached;
};

// `kAny` of all shapes and motions; else of the few shapes that do not turn.
template <bool kAny>
TALUS_INLINE Nearby LoadNearby(const StepView& step, double adhesion_gap, const WallView& wall,
                               const std::int32_t* first) {
  const Positions p = LoadPositions(step, first);
  const NearestPoint<Lanes> nearest = kAny ? Nearest(wall, p.at) : NearestOfFew(wall, p.at);
  const Lanes overlap = p.radius - nearest.distance;
  const Vector<Lanes> velocity =
      kAny ? WallBody(wall, p.at, nearest).velocity : Broadcast<Lanes>(wall.velocity);
  return {p, nearest, velocity, overlap, overlap > Lanes(-adhesion_gap)};
}

template <class Law, bool kAny>
TALUS_INLINE void WallPart(const StepView& step, const PanelView& panel,
                           const KernelConstants& constants, const WallView& wall,
                           const Part& part) {
  const double gap = constants.adhesion_gap;
  const Nearby a = LoadNearby<kAny>(step, gap, wall, part.first());
  const Nearby b = LoadNearby<kAny>(step, gap, wall, part.first() + Lanes::kWidth);
  const FloatMask active = part.valid & Join(a.reached, b.reached);
  if (Bits(active) == 0) return part.Clear();

  const Floats per_length(step.scales.length), per_speed(step.scales.speed);
  const Body<Floats> i =
      LoadBody(step, part.first(), per_length * Narrow(a.sphere.radius, b.sphere.radius));
  const Floats zero(0.0f);
  const Vector<Floats> none{zero, zero, zero};
  const Floats spin(kAny && wall.turns ? step.scales.spin : 0.0f);
  const Body<Floats> j{zero, zero, zero, per_speed * Narrow(a.velocity, b.velocity),
                       kAny ? spin * Broadcast<Floats>(wall.angular_velocity) : none};
  const Contact<Floats> contact = MakeContact(Narrow(a.nearest.normal, b.nearest.normal),
                                              per_length * Narrow(a.overlap, b.overlap), i.radius,
                                              i.radius * i.angular_velocity, i, j);
  const Response<Floats> on_i = Answer<Law>(constants.law, step, contact, active, part);
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
  const auto left = static_cast<float>(run.num_pairs - b * kBlock - lane);
  return {panel.blocks[at], panel.touching[at], lane, Floats::Iota() < Floats(left)};
}

// Not inlined: scenes without such walls must not pay for them.
template <class Law>
[[gnu::noinline]] void AnyWallPart(const StepView& step, const PanelView& panel, Place place) {
  const PairRun& run = *place.run;
  KernelConstants constants = step.constants[run.constants];
  constants.law.keeps_spring = false;  // between spheres only
  WallPart<Law, true>(step, panel, constants, step.walls[run.wall],
                      PartAt(panel, run, place.block, place.lane));
}

// Asks for what the sweep will come to soon. A panel's pairs reach `window` particles beyond their
// first one, so the rows come up one after the other, as do the blocks.
class Ahead {
 public:
  TALUS_INLINE Ahead(const StepView& step, const PanelView& panel)
      : step_(step), panel_(panel), next_row_(panel.fresh) {}

  // Where nothing touches, only which pairs a block has is read, as a rule.
  TALUS_INLINE void Block(const PairBlock* block, bool remembers) const {
    const auto* line = reinterpret_cast<const char*>(block);
    const std::size_t size = remembers ? sizeof(PairBlock) : offsetof(PairBlock, spring);
    for (std::size_t at = 0; at < size; at += 64) _mm_prefetch(line + at, _MM_HINT_T0);
  }
  TALUS_INLINE void Rows(std::int64_t first) {
    const std::int64_t wanted = first + (panel_.window_end - panel_.end) + kRowsAhead;
    const std::int64_t last = wanted < panel_.window_end ? wanted : panel_.window_end;
    // Four rows share a line of spots, and two one of single rows.
    for (; next_row_ < last; next_row_ += 4) {
      const auto fetch = [](const void* line) __attribute__((always_inline)) {
        _mm_prefetch(static_cast<const char*>(line), _MM_HINT_T0);
      };
      for (std::int64_t row = next_row_; row < next_row_ + 4; ++row) {
        fetch(step_.motion + 8 * row);
        fetch(panel_.forces + 8 * (row - panel_.begin));
      }
      fetch(step_.single + 8 * next_row_);
      fetch(step_.single + 8 * next_row_ + 16);
      fetch(step_.spot + 4 * next_row_);
    }
  }

 private:
  static constexpr std::int64_t kRowsAhead = 16;
  const StepView& step_;
  const PanelView& panel_;
  std::int64_t next_row_;
};

template <class Law>
void Forces(const StepView& step, const PanelView& panel) {
  Ahead ahead(step, panel);
  for (std::int64_t r = 0; r < panel.num_runs; ++r) {
    const PairRun run = panel.runs[r];
    KernelConstants constants = step.constants[run.constants];
    constants.law.keeps_spring = constants.law.keeps_spring && run.wall < 0;
    const std::int64_t num_blocks = (run.num_pairs + kBlock - 1) / kBlock;
    Batch<Law> batch(step, panel, constants);
    for (std::int64_t b = 0; b < num_blocks; ++b) {
      const std::int64_t at = run.first_block + b;
      ahead.Block(panel.blocks + at + 3, b + 3 >= num_blocks || panel.touching[at + 3] != 0);
      ahead.Rows(panel.blocks[at].first[0]);
      for (int lane = 0; lane < kBlock; lane += Floats::kWidth) {
        const Part part = PartAt(panel, run, b, lane);
        if (run.wall < 0) {
          SpherePart<Law>(step, panel, constants, part, batch);
          continue;
        }
        const WallView& wall = step.walls[run.wall];
        if (wall.turns || wall.kind >= ShapeKind::kAnnulus) {
          AnyWallPart<Law>(step, panel, {&panel.runs[r], b, lane});
        } else {
          WallPart<Law, false>(step, panel, constants, wall, part);
        }
      }
    }
    batch.Flush();
  }
}

}  // namespace talus::engine::TALUS_TARGET
