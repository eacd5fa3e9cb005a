// Pairs in reach from parts where few are, gathered until they fill a vector.
#pragma once

#include "engine/kernel/sphere_forces.h"

namespace talus::engine::TALUS_TARGET {

// A part costs the same however many of its lanes are in reach, and in a flowing powder that is
// about half of them.
template <class Law>
class Batch {
 public:
  TALUS_INLINE Batch(const StepView& step, const PanelView& panel, const KernelConstants& constants)
      : step_(step), panel_(panel), constants_(constants) {}

  TALUS_INLINE void Add(const Part& part, unsigned active) {
    part.Clear(active);
    for (unsigned bits = active; bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      first_[num_] = part.first()[lane];
      second_[num_] = part.second()[lane];
      places_[num_] = {&part.block, &part.touching, part.lane + lane};
      ++num_;
    }
  }
  TALUS_INLINE bool full() const { return num_ >= Floats::kWidth; }

  // Answers the first pairs, a vector at most.
  void Flush() {
    if (num_ == 0) return;
    for (int k = num_; k < Floats::kWidth; ++k) {
      first_[k] = first_[0];
      second_[k] = second_[0];
    }
    const Pairs pairs = LoadPairs(step_, constants_.adhesion_gap, first_, second_,
                                  Floats::Iota() < Floats(static_cast<float>(num_)));
    SphereForces<Law>(step_, panel_, constants_.law, pairs, *this);
    const int done = count();
    num_ -= done;
    for (int k = 0; k < num_; ++k) {
      first_[k] = first_[k + done];
      second_[k] = second_[k + done];
      places_[k] = places_[k + done];
    }
  }

  // The same as a Part gives.
  TALUS_INLINE const std::int32_t* first() const { return first_; }
  TALUS_INLINE const std::int32_t* second() const { return second_; }
  TALUS_INLINE void Load(History<Floats>& h) const {
    float rows[6][kBlock] = {};
    for (int k = 0; k < count(); ++k) {
      for (int c = 0; c < 3; ++c) {
        rows[c][k] = places_[k].block->spring[c][places_[k].lane];
        if (Law::Rolling::kHasMoment) rows[3 + c][k] = places_[k].block->moment[c][places_[k].lane];
      }
    }
    h = {{Floats::Load(rows[0]), Floats::Load(rows[1]), Floats::Load(rows[2])},
         {Floats::Load(rows[3]), Floats::Load(rows[4]), Floats::Load(rows[5])}};
  }
  TALUS_INLINE void Store(const History<Floats>& h, bool has_moment) const {
    float rows[6][kBlock];
    h.spring.x.Store(rows[0]);
    h.spring.y.Store(rows[1]);
    h.spring.z.Store(rows[2]);
    h.moment.x.Store(rows[3]);
    h.moment.y.Store(rows[4]);
    h.moment.z.Store(rows[5]);
    for (int k = 0; k < count(); ++k) {
      for (int c = 0; c < 3; ++c) {
        places_[k].block->spring[c][places_[k].lane] = rows[c][k];
        if (has_moment) places_[k].block->moment[c][places_[k].lane] = rows[3 + c][k];
      }
    }
  }
  TALUS_INLINE void SetTouching(unsigned bits) const {
    for (int k = 0; k < count(); ++k) {
      std::uint16_t& touching = *places_[k].touching;
      const unsigned bit = 1u << places_[k].lane;
      touching = static_cast<std::uint16_t>((touching & ~bit) | ((bits >> k & 1u) ? bit : 0u));
    }
  }

 private:
  struct Place {
    PairBlock* block;
    std::uint16_t* touching;
    int lane;
  };
  TALUS_INLINE int count() const { return num_ < Floats::kWidth ? num_ : Floats::kWidth; }

  const StepView& step_;
  const PanelView& panel_;
  const KernelConstants& constants_;
  std::int32_t first_[2 * kBlock];
  std::int32_t second_[2 * kBlock];
  Place places_[2 * kBlock];
  int num_ = 0;
};

}  // namespace talus::engine::TALUS_TARGET
