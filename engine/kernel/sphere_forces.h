// Pairs of spheres in reach, and their answer by the laws.
#pragma once

#include "engine/kernel/part.h"

namespace talus::engine::TALUS_TARGET {

// What `memory` remembers goes through the law; it may be a Part or a Batch.
template <class Law, class Memory>
TALUS_INLINE Response<Floats> Answer(const SingleConstants& constants, const StepView& step,
                                     const Contact<Floats>& contact, FloatMask active,
                                     const Memory& memory) {
  History<Floats> history;
  memory.Load(history);
  const Floats dt(step.scales.time_step);
  const Response<Floats> response = Respond<Law>(constants, contact, dt, history);
  const FloatMask touches = active & (contact.overlap > Floats(0.0f));
  history.spring = OrZero(touches, history.spring);
  history.moment = OrZero(touches, history.moment);
  memory.Store(history, Law::Rolling::kHasMoment);
  memory.SetTouching(Bits(touches));
  return {OrZero(active, response.force), OrZero(active, response.lever),
          OrZero(active, response.rolling)};
}

// Two spheres a lane: where they are, and whether they are in reach. In double precision, since an
// overlap is a small difference of large numbers.
struct Distances {
  Lanes radius_i, radius_j;
  Vector<Lanes> offset;
  Lanes square;     // of the distance d
  Lanes shortfall;  // (Rᵢ + Rⱼ)² − d²
  Mask reached;
};

TALUS_INLINE Distances LoadDistances(const StepView& step, double adhesion_gap,
                                     const std::int32_t* first, const std::int32_t* second) {
  const Positions i = LoadPositions(step, first), j = LoadPositions(step, second);
  const Vector<Lanes> offset = j.at - i.at;
  const Lanes square = Dot(offset, offset);
  const Lanes radii = i.radius + j.radius;
  const Lanes reach = radii + Lanes(adhesion_gap);
  return {i.radius, j.radius, offset, square, radii * radii - square, square < reach * reach};
}

// The same in single precision and the kernels' units.
struct Pairs {
  Floats radius_i, radius_j;
  Vector<Floats> offset;
  Floats square, shortfall;
  FloatMask active;
};

TALUS_INLINE Pairs LoadPairs(const StepView& step, double adhesion_gap, const std::int32_t* first,
                             const std::int32_t* second, FloatMask valid) {
  const Distances a = LoadDistances(step, adhesion_gap, first, second);
  const Distances b =
      LoadDistances(step, adhesion_gap, first + Lanes::kWidth, second + Lanes::kWidth);
  const Floats scale(step.scales.length), square_scale(step.scales.length_squared);
  return {scale * Narrow(a.radius_i, b.radius_i),
          scale * Narrow(a.radius_j, b.radius_j),
          scale * Narrow(a.offset, b.offset),
          square_scale * Narrow(a.square, b.square),
          square_scale * Narrow(a.shortfall, b.shortfall),
          valid & Join(a.reached, b.reached)};
}

template <class Law, class Memory>
TALUS_INLINE void SphereForces(const StepView& step, const PanelView& panel,
                               const SingleConstants& constants, const Pairs& pairs,
                               const Memory& memory) {
  const Body<Floats> i = LoadBody(step, memory.first(), pairs.radius_i);
  const Body<Floats> j = LoadBody(step, memory.second(), pairs.radius_j);
  const Floats inverse = Rsqrt(pairs.square);
  const Floats radii = i.radius + j.radius;
  const Vector<Floats> surface = i.radius * i.angular_velocity + j.radius * j.angular_velocity;
  const Contact<Floats> contact =
      MakeContact(inverse * pairs.offset, pairs.shortfall / (radii + pairs.square * inverse),
                  i.radius * j.radius / radii, surface, i, j);
  const Response<Floats> on_i = Answer<Law>(constants, step, contact, pairs.active, memory);
  AddToRows<false>(on_i.force, i.radius * on_i.lever + on_i.rolling, panel.forces, memory.first(),
                   panel.begin);
  AddToRows<true>(on_i.force, on_i.rolling - j.radius * on_i.lever, panel.forces, memory.second(),
                  panel.begin);
}

}  // namespace talus::engine::TALUS_TARGET
