// Hertz: the area, stiffness and damping of a contact, N1–N5.
//
//   s = √(R*δ)     k_n = (4/3) Y* s     F_n = k_n δ + η_n u_n
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

}  // namespace talus::engine
