// Four doubles in an AVX register. Included by simd.h only.
#pragma once

namespace talus::engine::TALUS_TARGET {

struct Mask {
  __m256d v;
};
TALUS_INLINE Mask operator&(Mask a, Mask b) { return {_mm256_and_pd(a.v, b.v)}; }
TALUS_INLINE unsigned Bits(Mask a) { return static_cast<unsigned>(_mm256_movemask_pd(a.v)); }

struct Lanes {
  static constexpr int kWidth = 4;
  __m256d v;

  Lanes() = default;
  TALUS_INLINE Lanes(__m256d value) : v(value) {}
  TALUS_INLINE explicit Lanes(double value) : v(_mm256_set1_pd(value)) {}

  static TALUS_INLINE Lanes Load(const double* from) { return _mm256_loadu_pd(from); }
  TALUS_INLINE void Store(double* to) const { _mm256_storeu_pd(to, v); }
  static TALUS_INLINE Lanes Iota() { return _mm256_set_pd(3, 2, 1, 0); }
};

TALUS_INLINE Lanes operator+(const Lanes& a, const Lanes& b) { return a.v + b.v; }
TALUS_INLINE Lanes operator-(const Lanes& a, const Lanes& b) { return a.v - b.v; }
TALUS_INLINE Lanes operator*(const Lanes& a, const Lanes& b) { return a.v * b.v; }
TALUS_INLINE Lanes operator/(const Lanes& a, const Lanes& b) { return a.v / b.v; }
TALUS_INLINE Lanes operator-(const Lanes& a) { return -a.v; }
TALUS_INLINE Mask operator>(const Lanes& a, const Lanes& b) {
  return {_mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ)};
}
TALUS_INLINE Mask operator<(const Lanes& a, const Lanes& b) { return b > a; }
TALUS_INLINE Mask operator<=(const Lanes& a, const Lanes& b) {
  return {_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ)};
}
TALUS_INLINE Lanes Select(Mask m, const Lanes& a, const Lanes& b) {
  return _mm256_blendv_pd(b.v, a.v, m.v);
}
TALUS_INLINE Lanes Min(const Lanes& a, const Lanes& b) { return _mm256_min_pd(a.v, b.v); }
TALUS_INLINE Lanes Max(const Lanes& a, const Lanes& b) { return _mm256_max_pd(a.v, b.v); }
TALUS_INLINE Lanes Abs(const Lanes& a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v); }
TALUS_INLINE Lanes Sqrt(const Lanes& a) { return _mm256_sqrt_pd(a.v); }
TALUS_INLINE Lanes Rsqrt(const Lanes& a) { return _mm256_set1_pd(1.0) / _mm256_sqrt_pd(a.v); }

// x, y, z, w of four rows of four doubles.
struct Quads {
  Lanes x, y, z, w;
};

// Row k starts at base + stride · index[k].
TALUS_INLINE Quads LoadQuads(const double* base, std::int64_t stride, const std::int32_t* index) {
  const auto halves = [&](int k, int m, int from) __attribute__((always_inline)) {
    return _mm256_insertf128_pd(
        _mm256_castpd128_pd256(_mm_loadu_pd(base + stride * index[k] + from)),
        _mm_loadu_pd(base + stride * index[m] + from), 1);
  };
  const __m256d xy02 = halves(0, 2, 0), xy13 = halves(1, 3, 0);
  const __m256d zw02 = halves(0, 2, 2), zw13 = halves(1, 3, 2);
  return {_mm256_unpacklo_pd(xy02, xy13), _mm256_unpackhi_pd(xy02, xy13),
          _mm256_unpacklo_pd(zw02, zw13), _mm256_unpackhi_pd(zw02, zw13)};
}

struct QuadRows {
  __m256d row[4];
};
TALUS_INLINE QuadRows Transpose(const Quads& q) {
  const __m256d xy02 = _mm256_unpacklo_pd(q.x.v, q.y.v), xy13 = _mm256_unpackhi_pd(q.x.v, q.y.v);
  const __m256d zw02 = _mm256_unpacklo_pd(q.z.v, q.w.v), zw13 = _mm256_unpackhi_pd(q.z.v, q.w.v);
  return {{_mm256_permute2f128_pd(xy02, zw02, 0x20), _mm256_permute2f128_pd(xy13, zw13, 0x20),
           _mm256_permute2f128_pd(xy02, zw02, 0x31), _mm256_permute2f128_pd(xy13, zw13, 0x31)}};
}

TALUS_INLINE void StoreQuads(const Quads& q, double* base, std::int64_t stride) {
  const QuadRows rows = Transpose(q);
  for (int k = 0; k < 4; ++k) _mm256_storeu_pd(base + stride * k, rows.row[k]);
}

// rows[index[k] − offset] += or −= (f, t) of lane k, one lane after the other: two lanes may name
// one row. A row is {fx, fy, fz, -, tx, ty, tz, -}.
template <bool kSubtract>
TALUS_INLINE void AddToRows(const Vector<Lanes>& f, const Vector<Lanes>& t, double* rows,
                            const std::int32_t* index, std::int64_t offset) {
  const Lanes zero(0.0);
  const QuadRows fs = Transpose({f.x, f.y, f.z, zero});
  const QuadRows ts = Transpose({t.x, t.y, t.z, zero});
  for (int k = 0; k < 4; ++k) {
    double* to = rows + 8 * (index[k] - offset);
    const __m256d old_f = _mm256_loadu_pd(to), old_t = _mm256_loadu_pd(to + 4);
    _mm256_storeu_pd(to, kSubtract ? old_f - fs.row[k] : old_f + fs.row[k]);
    _mm256_storeu_pd(to + 4, kSubtract ? old_t - ts.row[k] : old_t + ts.row[k]);
  }
}

}  // namespace talus::engine::TALUS_TARGET
