// The whole answer of a contact: what force and torques the two bodies feel.
#pragma once

#include "engine/laws/friction_laws.h"
#include "engine/laws/normal_laws.h"
#include "engine/laws/rolling_laws.h"

namespace talus::engine {

template <class V>
struct Response {
  Vector<V> force;    // on i, opposite on j [N]
  Vector<V> lever;    // n × force: the torque on i is Rᵢ times this plus `rolling`, (T3)
  Vector<V> rolling;  // T_r: on i, opposite on j [N m] (R5)
};

// What acts in a contact, as one type that the kernels are made for.
template <class NormalLaw, class FrictionLaw, class RollingLaw>
struct Laws {
  using Normal = NormalLaw;
  using Friction = FrictionLaw;
  using Rolling = RollingLaw;
};

// Advances the history by dt and gives the forces now. In the gap (δ ≤ 0) only adhesion acts, and
// the history is zero.
template <class Law, class V, class T>
TALUS_INLINE Response<V> Respond(const PairConstantsOf<T>& p, const Contact<V>& c, const V& dt,
                                 History<V>& history) {
  const ContactArea<V> area = MakeContactArea(c);
  const NormalForce<V> normal = Law::Normal::Force(p, c, area);
  Vector<V> tangential = Law::Friction::Force(p, c, area, normal.friction, dt, history.spring);
  const RollingState<V> rolling_state{c, area, normal.rolling, dt};
  Vector<V> rolling = Law::Rolling::Torque(p, rolling_state, history.moment);

  const auto touches = c.overlap > V(0.0);
  tangential = OrZero(touches, tangential);
  rolling = OrZero(touches, rolling);
  history.spring = OrZero(touches, history.spring);
  history.moment = OrZero(touches, history.moment);
  return {-(normal.total * c.normal + tangential), -Cross(c.normal, tangential), rolling};
}

}  // namespace talus::engine
