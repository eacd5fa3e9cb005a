// Pairs of spheres in reach, and their answer by the laws.
#pragma once

#include "engine/kernel/part.h"

namespace talus::engine::TALUS_TARGET {

// What `memory` remembers goes through the law; it may be a Part or a Batch.
template <class NormalLaw, class RollingLaw, class Memory>
TALUS_INLINE Response<Lanes> Answer(const PairConstants& constants, const StepView& step,
                                    const Contact<Lanes>& contact, Mask active,
                                    const Memory& memory) {
  History<Lanes> history;
  memory.Load(history);
  const Response<Lanes> response =
      Respond<NormalLaw, RollingLaw>(constants, contact, Lanes(step.time_step), history);
  const Mask touches = active & (contact.overlap > Lanes(0.0));
  history.spring = OrZero(touches, history.spring);
  history.moment = OrZero(touches, history.moment);
  memory.Store(history, RollingLaw::kHasMoment);
  memory.SetTouching(Bits(touches));
  return {OrZero(active, response.force), OrZero(active, response.lever),
          OrZero(active, response.rolling)};
}

// Two spheres a lane: where they are, and whether they are in reach.
struct Pairs {
  Positions i, j;
  Vector<Lanes> offset;
  Lanes square, radii;
  Mask active;

  TALUS_INLINE Pairs(const StepView& step, const PairConstants& constants,
                     const std::int32_t* first, const std::int32_t* second, Mask valid)
      : i(LoadPositions(step, first)),
        j(LoadPositions(step, second)),
        offset(j.at - i.at),
        square(Dot(offset, offset)),
        radii(i.radius + j.radius) {
    const Lanes reach = radii + Lanes(constants.adhesion_gap);
    active = valid & (square < reach * reach);
  }
};

template <class NormalLaw, class RollingLaw, class Memory>
TALUS_INLINE void SphereForces(const StepView& step, const PanelView& panel,
                               const PairConstants& constants, const Pairs& pairs,
                               const Memory& memory) {
  const Body<Lanes> i = LoadBody(step, memory.first(), pairs.i.radius);
  const Body<Lanes> j = LoadBody(step, memory.second(), pairs.j.radius);
  const Lanes inverse = Rsqrt(pairs.square);
  const Lanes inverse_radii = Rsqrt(pairs.radii * pairs.radii);
  const Vector<Lanes> surface = i.radius * i.angular_velocity + j.radius * j.angular_velocity;
  const Contact<Lanes> contact =
      MakeContact(inverse * pairs.offset, pairs.radii - pairs.square * inverse,
                  i.radius * j.radius * inverse_radii, surface, i, j);
  const Response<Lanes> on_i =
      Answer<NormalLaw, RollingLaw>(constants, step, contact, pairs.active, memory);
  AddToRows<false>(on_i.force, i.radius * on_i.lever + on_i.rolling, panel.forces, memory.first(),
                   panel.begin);
  AddToRows<true>(on_i.force, on_i.rolling - j.radius * on_i.lever, panel.forces, memory.second(),
                  panel.begin);
}

}  // namespace talus::engine::TALUS_TARGET
