// Forces of one panel: eight pairs at a time, all of one run with the same two materials.
//
// Each block is loaded, answered by the law and added to the force rows in list order, so that the
// sums do not depend on who computes what. Pairs out of reach cost the distance test only.
#pragma once

#include "engine/kernel/shapes.h"
#include "engine/kernel/simd.h"

namespace talus::engine::TALUS_TARGET {

struct Positions {
  Vector<Lanes> at;
  Lanes radius;
};

TALUS_INLINE Positions LoadPositions(const StepView& step, const std::int32_t* index) {
  const Quads q = LoadQuads(step.motion, 8, index);
  return {{q.x, q.y, q.z}, q.w};
}

TALUS_INLINE Body<Lanes> LoadBody(const StepView& step, const std::int32_t* index,
                                  const Lanes& radius) {
  const Quads v = LoadQuads(step.motion + 4, 8, index);
  const Quads w = LoadQuads(step.spin, 4, index);
  return {radius, v.w, w.w, {v.x, v.y, v.z}, {w.x, w.y, w.z}};
}

// A part of a block, one vector wide.
struct Part {
  PairBlock& block;
  std::uint8_t& touching;
  int lane;  // the part's first lane in its block
  Mask valid;

  TALUS_INLINE const std::int32_t* first() const { return block.first + lane; }
  TALUS_INLINE const std::int32_t* second() const { return block.second + lane; }
  TALUS_INLINE unsigned mask() const { return (1u << Lanes::kWidth) - 1u; }

  TALUS_INLINE void Load(History<Lanes>& h) const {
    h.spring = LoadVector(block.spring);
    h.moment = LoadVector(block.moment);
  }
  TALUS_INLINE void Store(const History<Lanes>& h, bool has_moment) const {
    StoreVector(h.spring, block.spring);
    if (has_moment) StoreVector(h.moment, block.moment);
  }
  TALUS_INLINE void SetTouching(unsigned bits) const {
    touching = static_cast<std::uint8_t>((touching & ~(mask() << lane)) | (bits << lane));
  }
  // Nothing of this part is in reach: forget what it remembers.
  TALUS_INLINE void Clear() const {
    if (((touching >> lane) & mask()) == 0) return;
    const Lanes zero(0.0);
    const Vector<Lanes> none{zero, zero, zero};
    Store({none, none}, true);
    SetTouching(0);
  }

 private:
  TALUS_INLINE Vector<Lanes> LoadVector(const double (&from)[3][kBlock]) const {
    return {Lanes::Load(from[0] + lane), Lanes::Load(from[1] + lane), Lanes::Load(from[2] + lane)};
  }
  TALUS_INLINE void StoreVector(const Vector<Lanes>& a, double (&to)[3][kBlock]) const {
    a.x.Store(to[0] + lane);
    a.y.Store(to[1] + lane);
    a.z.Store(to[2] + lane);
  }
};

template <class NormalLaw, class RollingLaw>
TALUS_INLINE Response<Lanes> Answer(const PairConstants& constants, const StepView& step,
                                    const Contact<Lanes>& contact, Mask active, const Part& part) {
  History<Lanes> history;
  part.Load(history);
  const Response<Lanes> response =
      Respond<NormalLaw, RollingLaw>(constants, contact, Lanes(step.time_step), history);
  const Mask touches = active & (contact.overlap > Lanes(0.0));
  history.spring = OrZero(touches, history.spring);
  history.moment = OrZero(touches, history.moment);
  part.Store(history, RollingLaw::kHasMoment);
  part.SetTouching(Bits(touches));
  return {OrZero(active, response.force), OrZero(active, response.lever),
          OrZero(active, response.rolling)};
}

template <class NormalLaw, class RollingLaw>
TALUS_INLINE void SpherePart(const StepView& step, const PanelView& panel,
                             const PairConstants& constants, const Part& part) {
  const Positions pi = LoadPositions(step, part.first());
  const Positions pj = LoadPositions(step, part.second());
  const Vector<Lanes> offset = pj.at - pi.at;
  const Lanes square = Dot(offset, offset);
  const Lanes radii = pi.radius + pj.radius;
  const Lanes reach = radii + Lanes(constants.adhesion_gap);
  const Mask active = part.valid & (square < reach * reach);
  if (Bits(active) == 0) return part.Clear();

  const Body<Lanes> i = LoadBody(step, part.first(), pi.radius);
  const Body<Lanes> j = LoadBody(step, part.second(), pj.radius);
  const Lanes inverse = Rsqrt(square);
  const Lanes inverse_radii = Rsqrt(radii * radii);
  const Vector<Lanes> surface = i.radius * i.angular_velocity + j.radius * j.angular_velocity;
  const Contact<Lanes> contact = MakeContact(inverse * offset, radii - square * inverse,
                                             i.radius * j.radius * inverse_radii, surface, i, j);
  const Response<Lanes> on_i =
      Answer<NormalLaw, RollingLaw>(constants, step, contact, active, part);
  AddToRows<false>(on_i.force, i.radius * on_i.lever + on_i.rolling, panel.forces, part.first(),
                   panel.begin);
  AddToRows<true>(on_i.force, on_i.rolling - j.radius * on_i.lever, panel.forces, part.second(),
                  panel.begin);
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
  const Run* run;
  std::int64_t block;
  int lane;
};

TALUS_INLINE Part PartAt(const PanelView& panel, const Run& run, std::int64_t b, int lane) {
  const std::int64_t at = run.first_block + b;
  const auto left = static_cast<double>(run.num_pairs - b * kBlock - lane);
  return {panel.blocks[at], panel.touching[at], lane, Lanes::Iota() < Lanes(left)};
}

// Not inlined: scenes without such walls must not pay for them.
template <class NormalLaw, class RollingLaw>
[[gnu::noinline]] void AnyWallPart(const StepView& step, const PanelView& panel, Place place) {
  const Run& run = *place.run;
  WallPart<NormalLaw, RollingLaw, true>(step, panel, step.constants[run.constants],
                                        step.walls[run.wall],
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
    const Run run = panel.runs[r];
    const PairConstants constants = step.constants[run.constants];
    const std::int64_t num_blocks = (run.num_pairs + kBlock - 1) / kBlock;
    for (std::int64_t b = 0; b < num_blocks; ++b) {
      const std::int64_t at = run.first_block + b;
      ahead.Block(panel.blocks + at + 3);
      ahead.Rows(panel.blocks[at].first[0]);
      for (int lane = 0; lane < kBlock; lane += Lanes::kWidth) {
        const Part part = PartAt(panel, run, b, lane);
        if (run.wall < 0) {
          SpherePart<NormalLaw, RollingLaw>(step, panel, constants, part);
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
  }
}

}  // namespace talus::engine::TALUS_TARGET
