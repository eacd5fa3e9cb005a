// Two doubles in an SSE2 register: what every x86-64 has. Included by simd.h only.
#pragma once

namespace talus::engine::TALUS_TARGET {

struct Mask {
  __m128d v;
};
TALUS_INLINE Mask operator&(Mask a, Mask b) { return {_mm_and_pd(a.v, b.v)}; }
TALUS_INLINE unsigned Bits(Mask a) { return static_cast<unsigned>(_mm_movemask_pd(a.v)); }

struct Lanes {
  static constexpr int kWidth = 2;
  __m128d v;

  Lanes() = default;
  TALUS_INLINE Lanes(__m128d value) : v(value) {}
  TALUS_INLINE explicit Lanes(double value) : v(_mm_set1_pd(value)) {}

  static TALUS_INLINE Lanes Load(const double* from) { return _mm_loadu_pd(from); }
  TALUS_INLINE void Store(double* to) const { _mm_storeu_pd(to, v); }
  static TALUS_INLINE Lanes Iota() { return _mm_set_pd(1, 0); }
};

TALUS_INLINE Lanes operator+(const Lanes& a, const Lanes& b) { return a.v + b.v; }
TALUS_INLINE Lanes operator-(const Lanes& a, const Lanes& b) { return a.v - b.v; }
TALUS_INLINE Lanes operator*(const Lanes& a, const Lanes& b) { return a.v * b.v; }
TALUS_INLINE Lanes operator/(const Lanes& a, const Lanes& b) { return a.v / b.v; }
TALUS_INLINE Lanes operator-(const Lanes& a) { return -a.v; }
TALUS_INLINE Mask operator>(const Lanes& a, const Lanes& b) { return {_mm_cmpgt_pd(a.v, b.v)}; }
TALUS_INLINE Mask operator<(const Lanes& a, const Lanes& b) { return b > a; }
TALUS_INLINE Mask operator<=(const Lanes& a, const Lanes& b) { return {_mm_cmple_pd(a.v, b.v)}; }
TALUS_INLINE Lanes Select(Mask m, const Lanes& a, const Lanes& b) {
  return _mm_or_pd(_mm_and_pd(m.v, a.v), _mm_andnot_pd(m.v, b.v));
}
TALUS_INLINE Lanes Min(const Lanes& a, const Lanes& b) { return _mm_min_pd(a.v, b.v); }
TALUS_INLINE Lanes Max(const Lanes& a, const Lanes& b) { return _mm_max_pd(a.v, b.v); }
TALUS_INLINE Lanes Abs(const Lanes& a) { return _mm_andnot_pd(_mm_set1_pd(-0.0), a.v); }
TALUS_INLINE Lanes Sqrt(const Lanes& a) { return _mm_sqrt_pd(a.v); }
TALUS_INLINE Lanes Rsqrt(const Lanes& a) { return _mm_set1_pd(1.0) / _mm_sqrt_pd(a.v); }

// x, y, z, w of two rows of four doubles.
struct Quads {
  Lanes x, y, z, w;
};

// Row k starts at base + stride · index[k].
TALUS_INLINE Quads LoadQuads(const double* base, std::int64_t stride, const std::int32_t* index) {
  const double* row0 = base + stride * index[0];
  const double* row1 = base + stride * index[1];
  const __m128d xy0 = _mm_loadu_pd(row0), xy1 = _mm_loadu_pd(row1);
  const __m128d zw0 = _mm_loadu_pd(row0 + 2), zw1 = _mm_loadu_pd(row1 + 2);
  return {_mm_unpacklo_pd(xy0, xy1), _mm_unpackhi_pd(xy0, xy1), _mm_unpacklo_pd(zw0, zw1),
          _mm_unpackhi_pd(zw0, zw1)};
}

TALUS_INLINE void StoreQuads(const Quads& q, double* base, std::int64_t stride) {
  _mm_storeu_pd(base, _mm_unpacklo_pd(q.x.v, q.y.v));
  _mm_storeu_pd(base + 2, _mm_unpacklo_pd(q.z.v, q.w.v));
  _mm_storeu_pd(base + stride, _mm_unpackhi_pd(q.x.v, q.y.v));
  _mm_storeu_pd(base + stride + 2, _mm_unpackhi_pd(q.z.v, q.w.v));
}

// rows[index[k] − offset] += or −= (f, t) of lane k, one lane after the other: two lanes may name
// one row. A row is {fx, fy, fz, -, tx, ty, tz, -}.
template <bool kSubtract>
TALUS_INLINE void AddToRows(const Vector<Lanes>& f, const Vector<Lanes>& t, double* rows,
                            const std::int32_t* index, std::int64_t offset) {
  double values[2][8];
  const Lanes zero(0.0);
  StoreQuads({f.x, f.y, f.z, zero}, values[0], 8);
  StoreQuads({t.x, t.y, t.z, zero}, values[0] + 4, 8);
  for (int k = 0; k < 2; ++k) {
    double* to = rows + 8 * (index[k] - offset);
    for (int c = 0; c < 8; ++c) to[c] = kSubtract ? to[c] - values[k][c] : to[c] + values[k][c];
  }
}

}  // namespace talus::engine::TALUS_TARGET
