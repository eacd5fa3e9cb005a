// A contact as the laws see it: equations K1–K3 of docs/physics.md.
#pragma once

#include "engine/laws/number.h"

namespace talus::engine {

// What one body brings into a contact.
template <class V>
struct Body {
  V radius;                    // R [m]
  V inverse_mass;              // 1/m [1/kg]; 0 for a wall
  V inverse_inertia;           // 1/I [1/(kg m²)], I = (2/5) m R²; 0 for a wall
  Vector<V> velocity;          // v [m/s]
  Vector<V> angular_velocity;  // ω [rad/s]
};

template <class V>
struct Contact {
  Vector<V> normal;   // n [-], from i to j
  V overlap;          // δ [m] (K1)
  V closing_speed;    // u_n [m/s] (K3), > 0 approaching
  Vector<V> sliding;  // u_t [m/s] (K3)
  Vector<V> spin;     // ω_rel [rad/s]
  Vector<V> surface;  // Rᵢωᵢ + Rⱼωⱼ [m/s]
  V r_star;           // R* [m] (P1)
  V root_m_star;      // √m* [√kg] (P2)
  V root_i_star;      // √I* [√(kg m²)] (R3)
};

// What a contact remembers while δ > 0.
template <class V>
struct History {
  Vector<V> spring;  // δ_t [m] (K4)
  Vector<V> moment;  // M [N m] (R2)
};

// The masses enter by their inverses, so that a wall is a body with none: m* = 1/(1/mᵢ + 1/mⱼ), and
// I* = 3.5/(1/Iᵢ + 1/Iⱼ), because 1.4 m R² = 3.5 I.
template <class V>
TALUS_INLINE Contact<V> MakeContact(const Vector<V>& normal, const V& overlap, const V& r_star,
                                    const Vector<V>& surface, const Body<V>& i, const Body<V>& j) {
  Contact<V> c;
  c.normal = normal;
  c.overlap = overlap;
  c.r_star = r_star;
  c.surface = surface;
  const Vector<V> u = i.velocity - j.velocity + Cross(surface, normal);  // K2
  c.closing_speed = Dot(u, normal);
  c.sliding = u - c.closing_speed * normal;
  c.spin = i.angular_velocity - j.angular_velocity;
  c.root_m_star = Rsqrt(i.inverse_mass + j.inverse_mass);
  c.root_i_star = V(1.8708286933869707) * Rsqrt(i.inverse_inertia + j.inverse_inertia);  // √3.5
  return c;
}

}  // namespace talus::engine
