// Normal force with and without adhesion: N5, A1–A5. A new law is one struct here and one line in
// laws/law_list.h.
#pragma once

#include "engine/laws/hertz_mindlin.h"

namespace talus::engine {

// Hertz alone.
struct NoAdhesion {
  template <class V, class T>
  static TALUS_INLINE NormalForce<V> Force(const PairConstantsOf<T>& p, const Contact<V>& c,
                                           const ContactArea<V>& area) {
    const V force = HertzForce(p, c, area);
    return {force, force, force};
  }
};

// Hertz less a constant pull, which fades with 1/gap² before contact (A3):
//   F_po for δ ≥ δ₀;  A R*/(6δ²) for δ_c < δ < δ₀.
// The pull is there for δ ≤ 0 too, where Hertz is not; the loop knows from adhesion_gap.
struct DmtAdhesion {
  template <class V, class T>
  static TALUS_INLINE NormalForce<V> Force(const PairConstantsOf<T>& p, const Contact<V>& c,
                                           const ContactArea<V>& area) {
    const auto touches = c.overlap > V(0.0);
    const V hertz = Select(touches, HertzForce(p, c, area), V(0.0));
    const V plateau = V(p.pull_off) * c.r_star;
    const V fading = V(p.hamaker) * c.r_star / (c.overlap * c.overlap);
    const V pull = Select(-c.overlap > V(p.plateau_gap), fading, plateau);
    return {hertz - pull, hertz, hertz};
  }
};

// Simplified JKR: the contact area a is larger than Hertz's, and the elastic force is (A5)
//   4Y*a³/(3R*) − √(8πγ*Y*a³),   a⁴ − 2R*δ a² − (2πγ*R*²/Y*) a + R*²δ² = 0, largest root (A4).
// It bounds the rolling torque as it is, friction when 3πγ*R* is added (A5, A6).
// Acts for δ > 0. Damping and tangential stiffness are Hertz–Mindlin's, with s = √(R*δ).
struct JkrAdhesion {
  // (A4) is (a² − R*δ)² = B a, so its largest root solves y⁴ − √B y − R*δ = 0 for y = √a. That is
  // convex; from y₀² = √(R*δ) + ∛B, which lies above the root by a sixth at most, Newton's step
  // squares the error each time: five reach round-off.
  template <class V>
  static TALUS_INLINE V AreaRadius(const V& r_star_overlap, const V& root_b, const V& cube_root_b) {
    V y = Sqrt(Sqrt(r_star_overlap) + cube_root_b);
    for (int step = 0; step < 5; ++step) {
      const V cube = y * y * y;
      y = y - (cube * y - root_b * y - r_star_overlap) / (V(4.0) * cube - root_b);
    }
    return y * y;
  }

  // ∛R* from above, to two percent for R* from 1 µm to 1 m: each t ← ⁴√(R* t) leaves a quarter of
  // the error's logarithm.
  template <class V>
  static TALUS_INLINE V CubeRootBound(const V& r_star) {
    V t(1.0);
    for (int step = 0; step < 4; ++step) t = Sqrt(Sqrt(r_star * t));
    return t;
  }

  template <class V, class T>
  static TALUS_INLINE NormalForce<V> Force(const PairConstantsOf<T>& p, const Contact<V>& c,
                                           const ContactArea<V>& area) {
    const V b = V(p.pull_off / p.y_star) * c.r_star * c.r_star;  // B = 2πγ*R*²/Y*
    const V cube_root_r = CubeRootBound(c.r_star);
    const V cube_root_b = V(p.jkr_cube_root) * cube_root_r * cube_root_r;
    const V a = AreaRadius(c.r_star * c.overlap, Sqrt(b), cube_root_b);
    const V cube = a * a * a;
    const V elastic =
        V(p.normal_stiffness) * cube / c.r_star - Sqrt(V(4 * p.pull_off * p.y_star) * cube);
    const V damping = V(p.normal_damping) * area.root_s * c.root_m_star;
    const V total = elastic + damping * c.closing_speed;
    return {total, total + V(1.5 * p.pull_off) * c.r_star,
            total + V(p.rolling_pull_off) * c.r_star};
  }
};

}  // namespace talus::engine
