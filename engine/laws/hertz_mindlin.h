// Hertz–Mindlin: stiffness, damping and Coulomb's limit of a contact, N1–N5 and T1–T2.
//
//   s = √(R*δ)     k_n = (4/3) Y* s     k_t = 8 G* s
//   F_n = k_n δ + η_n u_n               F_t = k_t δ_t + η_t u_t,   |F_t| ≤ μ_t |F_n|
//
// F_n is not clamped at zero: e is exact only with the short pull before separation.
#pragma once

#include "engine/laws/contact.h"
#include "engine/laws/pair_constants.h"

namespace talus::engine {

// What follows from the size of the contact area. s is its radius.
template <class V>
struct ContactArea {
  V s;          // √(R*δ) [m]
  V inverse_s;  // [1/m]
  V root_s;     // √s [√m], for the dampings
};

template <class V>
TALUS_INLINE ContactArea<V> MakeContactArea(const Contact<V>& c) {
  const V square = c.r_star * c.overlap;
  const V inverse = Rsqrt(square);
  const V s = square * inverse;
  return {s, inverse, Sqrt(s)};
}

template <class V>
struct NormalForce {
  V total;     // pushes the bodies apart, adhesion included [N]
  V friction;  // whose absolute value bounds friction (T2) [N]
  V rolling;   // and rolling torque (R4) [N]
};

template <class V, class T>
TALUS_INLINE V HertzForce(const PairConstantsOf<T>& p, const Contact<V>& c,
                          const ContactArea<V>& area) {  // N5
  const V damping = V(p.normal_damping) * area.root_s * c.root_m_star;
  return V(p.normal_stiffness) * area.s * c.overlap + damping * c.closing_speed;
}

// The friction on i is minus the result. Advances the spring (K4) and shortens it when the contact
// slides (T2), unless it is kept (A7).
template <class V, class T>
TALUS_INLINE Vector<V> Friction(const PairConstantsOf<T>& p, const Contact<V>& c,
                                const ContactArea<V>& area, const V& limiting, const V& dt,
                                Vector<V>& spring) {
  spring = spring + dt * c.sliding;
  spring = spring - Dot(spring, c.normal) * c.normal;
  const V stiffness = V(p.shear_stiffness) * area.s;
  const Vector<V> dashpot = (V(p.tangential_damping) * area.root_s * c.root_m_star) * c.sliding;
  const Vector<V> trial = stiffness * spring + dashpot;  // T1
  const V square = Dot(trial, trial);
  const V limit = V(p.sliding_friction) * Abs(limiting);
  const auto slides = square > limit * limit;
  const V scale = Select(slides, limit * Rsqrt(square), V(1.0));
  const Vector<V> force = scale * trial;
  if (p.keeps_spring) return force;
  const V compliance = area.inverse_s * V(p.shear_compliance);
  spring = Select(slides, compliance * (force - dashpot), spring);
  return force;
}

}  // namespace talus::engine
