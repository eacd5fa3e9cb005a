// Eight pairs as a kernel meets them: their bodies, and what they remember.
#pragma once

#include "engine/kernel/kernel.h"
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
  // Only the lanes of `kept` are in reach: the others forget.
  TALUS_INLINE void Clear(unsigned kept) const {
    unsigned gone = (touching >> lane) & mask() & ~kept;
    for (; gone != 0; gone &= gone - 1) {
      const int at = lane + __builtin_ctz(gone);
      for (int c = 0; c < 3; ++c) block.spring[c][at] = block.moment[c][at] = 0;
      touching = static_cast<std::uint8_t>(touching & ~(1u << at));
    }
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

}  // namespace talus::engine::TALUS_TARGET
