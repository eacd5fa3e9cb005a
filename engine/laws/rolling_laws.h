// Rolling resistance: R1–R4, R6; the opposite torque on the other sphere, R5, is the caller's.
// Twist about the normal is never resisted. A new law is one struct here and one line in
// laws/law_list.h.
#pragma once

#include "engine/laws/hertz_mindlin.h"

namespace talus::engine {

// What every rolling law is given. The torque on i is the law's result, on j the opposite.
template <class V>
struct RollingState {
  const Contact<V>& contact;
  const ContactArea<V>& area;
  V limiting;  // F_n of (R4) [N]
  V dt;        // Δt [s]
};

template <class V>
TALUS_INLINE Vector<V> RollingSpin(const Contact<V>& c) {  // ω_p
  return c.spin - Dot(c.spin, c.normal) * c.normal;
}

// a/|a|, or 0 for 0.
template <class V>
TALUS_INLINE Vector<V> Direction(const Vector<V>& a) {
  const V square = Dot(a, a);
  return OrZero(square > V(0.0), Rsqrt(square) * a);
}

struct NoRolling {
  static constexpr bool kHasMoment = false;
  template <class V, class T>
  static TALUS_INLINE Vector<V> Torque(const PairConstantsOf<T>&, const RollingState<V>&,
                                       Vector<V>&) {
    return {V(0.0), V(0.0), V(0.0)};
  }
};

// T_r = −μ_r R* |F_n| ω_p/|ω_p|
struct ConstantRolling {
  static constexpr bool kHasMoment = false;
  template <class V, class T>
  static TALUS_INLINE Vector<V> Torque(const PairConstantsOf<T>& p, const RollingState<V>& s,
                                       Vector<V>&) {
    const V limit = V(p.rolling_friction) * s.contact.r_star * Abs(s.limiting);
    return -limit * Direction(RollingSpin(s.contact));
  }
};

// The same times |Rᵢωᵢ×n + Rⱼωⱼ×n|, in m/s.
struct ViscousRolling {
  static constexpr bool kHasMoment = false;
  template <class V, class T>
  static TALUS_INLINE Vector<V> Torque(const PairConstantsOf<T>& p, const RollingState<V>& s,
                                       Vector<V>& moment) {
    const Vector<V> slip = Cross(s.contact.surface, s.contact.normal);
    return V(p.rolling_per_speed) * Sqrt(Dot(slip, slip)) * ConstantRolling::Torque(p, s, moment);
  }
};

// Winds the spring up by ω_p Δt (R2), and takes it back to its limit (R4); whether it met that.
//
// The spring is kept perpendicular to the normal. When the normal turns, a part of M would come to
// lie along it and drive twist, which nothing resists: energy from nowhere.
template <class V, class T>
TALUS_INLINE auto WindUp(const PairConstantsOf<T>& p, const RollingState<V>& s, const V& stiffness,
                         const Vector<V>& omega, Vector<V>& moment) {
  const Contact<V>& c = s.contact;
  moment = moment - (stiffness * s.dt) * omega;
  moment = moment - Dot(moment, c.normal) * c.normal;
  const V square = Dot(moment, moment);
  const V limit = V(p.rolling_friction) * c.r_star * Abs(s.limiting);
  const auto mobilised = square > limit * limit;
  moment = Select(mobilised, limit * Rsqrt(square), V(1.0)) * moment;
  return mobilised;
}

// A spring and a dashpot in rolling with a limit on the spring [ai2011, model C].
struct EpsdRolling {
  static constexpr bool kHasMoment = true;
  template <class V, class T>
  static TALUS_INLINE Vector<V> Torque(const PairConstantsOf<T>& p, const RollingState<V>& s,
                                       Vector<V>& moment) {
    const Contact<V>& c = s.contact;
    const Vector<V> omega = RollingSpin(c);
    const V stiffness = V(p.rolling_stiffness) * s.area.s * c.r_star * c.r_star;        // R1
    const V damping = V(p.rolling_damping) * c.r_star * s.area.root_s * c.root_i_star;  // R3
    const auto mobilised = WindUp(p, s, stiffness, omega, moment);
    return moment - (Select(mobilised, V(p.mobilised_damping), V(1.0)) * damping) * omega;
  }
};

// EPSD with the tangential spring's stiffness and no dashpot: `epsd2` of LIGGGHTS.
//
//   k_r = k_t R*²      T_r = M                                          docs/physics.md, R6
//
// Only the tangential dashpot damps a swing below the limit: with e = 1 a grain rocks for ever.
struct Epsd2Rolling {
  static constexpr bool kHasMoment = true;
  template <class V, class T>
  static TALUS_INLINE Vector<V> Torque(const PairConstantsOf<T>& p, const RollingState<V>& s,
                                       Vector<V>& moment) {
    const Contact<V>& c = s.contact;
    const V stiffness = V(p.shear_stiffness) * s.area.s * c.r_star * c.r_star;
    WindUp(p, s, stiffness, RollingSpin(c), moment);
    return moment;
  }
};

}  // namespace talus::engine
