// Mindlin's tangential force and what bounds it: T1, T2, T4. A new law is one struct here and one
// row in laws/law_list.h.
//
//   k_t = 8 G* s     F_t = k_t δ_t + η_t u_t     |F_t| ≤ μ_t |F_n|, or ≤ μ_t k_n δ
//
// The friction on i is minus a law's result. The spring is advanced (K4), and shortened when the
// contact slides. A step of it that both laws share has no function of its own: the compiler would
// fuse other products, and every scene's bits would move.
#pragma once

#include "engine/laws/hertz_mindlin.h"

namespace talus::engine {

// Coulomb's limit of the whole normal force, as published (T2). A sliding spring gets what the
// dashpot leaves of the limit, unless it is kept (A7).
struct TotalForceLimit {
  template <class V, class T>
  static TALUS_INLINE Vector<V> Force(const PairConstantsOf<T>& p, const Contact<V>& c,
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
};

// Coulomb's limit of the elastic normal force alone (T4), without adhesion.
//
// Over an impact ∫ k_n δ dt = (1 + e) m* u_n, so that one that slides all through takes Coulomb's
// impulse. (T2) lets the dashpot take more than the limit; the spring then pushes forward, and what
// began by sliding later slides back. Here it is left nothing.
struct ElasticForceLimit {
  template <class V, class T>
  static TALUS_INLINE Vector<V> Force(const PairConstantsOf<T>& p, const Contact<V>& c,
                                      const ContactArea<V>& area, const V&, const V& dt,
                                      Vector<V>& spring) {
    spring = spring + dt * c.sliding;
    spring = spring - Dot(spring, c.normal) * c.normal;
    const V stiffness = V(p.shear_stiffness) * area.s;
    const Vector<V> dashpot = (V(p.tangential_damping) * area.root_s * c.root_m_star) * c.sliding;
    const Vector<V> trial = stiffness * spring + dashpot;  // T1
    const V square = Dot(trial, trial);
    const V elastic = V(p.normal_stiffness) * area.s * c.overlap;
    const V limit = V(p.sliding_friction) * elastic;
    const auto slides = square > limit * limit;
    const V scale = Select(slides, limit * Rsqrt(square), V(1.0));
    const Vector<V> force = scale * trial;
    const Vector<V> rest = force - dashpot;
    const V compliance = area.inverse_s * V(p.shear_compliance);
    spring = Select(slides, OrZero(Dot(rest, force) > V(0.0), compliance * rest), spring);
    return force;
  }
};

}  // namespace talus::engine
