// Sixteen pairs, or as many as a vector holds, as a kernel meets them: their bodies, and what they
// remember.
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

TALUS_INLINE Vector<Floats> Narrow(const Vector<Lanes>& low, const Vector<Lanes>& high) {
  return {Narrow(low.x, high.x), Narrow(low.y, high.y), Narrow(low.z, high.z)};
}

TALUS_INLINE Body<Floats> LoadBody(const StepView& step, const std::int32_t* index,
                                   const Floats& radius) {
  const auto [v, w] = LoadRows(step.single, index);
  return {radius, v.w, w.w, {v.x, v.y, v.z}, {w.x, w.y, w.z}};
}

// A part of a block, one vector of floats wide.
struct Part {
  PairBlock& block;
  std::uint16_t& touching;
  int lane;  // the part's first lane in its block
  FloatMask valid;

  TALUS_INLINE const std::int32_t* first() const { return block.first + lane; }
  TALUS_INLINE const std::int32_t* second() const { return block.second + lane; }
  TALUS_INLINE unsigned mask() const { return (1u << Floats::kWidth) - 1u; }

  TALUS_INLINE void Load(History<Floats>& h) const {
    h.spring = LoadVector(block.spring);
    h.moment = LoadVector(block.moment);
  }
  TALUS_INLINE void Store(const History<Floats>& h, bool has_moment) const {
    StoreVector(h.spring, block.spring);
    if (has_moment) StoreVector(h.moment, block.moment);
  }
  TALUS_INLINE void SetTouching(unsigned bits) const {
    touching = static_cast<std::uint16_t>((touching & ~(mask() << lane)) | (bits << lane));
  }
  // Only the lanes of `kept` are in reach: the others forget.
  TALUS_INLINE void Clear(unsigned kept) const {
    unsigned gone = (touching >> lane) & mask() & ~kept;
    for (; gone != 0; gone &= gone - 1) {
      const int at = lane + __builtin_ctz(gone);
      for (int c = 0; c < 3; ++c) block.spring[c][at] = block.moment[c][at] = 0;
      touching = static_cast<std::uint16_t>(touching & ~(1u << at));
    }
  }
  // Nothing of this part is in reach: forget what it remembers.
  TALUS_INLINE void Clear() const {
    if (((touching >> lane) & mask()) == 0) return;
    const Floats zero(0.0f);
    const Vector<Floats> none{zero, zero, zero};
    Store({none, none}, true);
    SetTouching(0);
  }

 private:
  TALUS_INLINE Vector<Floats> LoadVector(const float (&from)[3][kBlock]) const {
    return {Floats::Load(from[0] + lane), Floats::Load(from[1] + lane),
            Floats::Load(from[2] + lane)};
  }
  TALUS_INLINE void StoreVector(const Vector<Floats>& a, float (&to)[3][kBlock]) const {
    a.x.Store(to[0] + lane);
    a.y.Store(to[1] + lane);
    a.z.Store(to[2] + lane);
  }
};

}  // namespace talus::engine::TALUS_TARGET
