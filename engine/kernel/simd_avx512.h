// Eight doubles in an AVX-512 register. Included by simd.h only.
#pragma once

namespace talus::engine::TALUS_TARGET {

struct Mask {
  __mmask8 bits;
};
TALUS_INLINE Mask operator&(Mask a, Mask b) { return {static_cast<__mmask8>(a.bits & b.bits)}; }
TALUS_INLINE unsigned Bits(Mask a) { return a.bits; }

struct Lanes {
  static constexpr int kWidth = 8;
  __m512d v;

  Lanes() = default;
  TALUS_INLINE Lanes(__m512d value) : v(value) {}
  TALUS_INLINE explicit Lanes(double value) : v(_mm512_set1_pd(value)) {}

  static TALUS_INLINE Lanes Load(const double* from) { return _mm512_loadu_pd(from); }
  TALUS_INLINE void Store(double* to) const { _mm512_storeu_pd(to, v); }
  static TALUS_INLINE Lanes Iota() { return _mm512_set_pd(7, 6, 5, 4, 3, 2, 1, 0); }
};

TALUS_INLINE Lanes operator+(const Lanes& a, const Lanes& b) { return a.v + b.v; }
TALUS_INLINE Lanes operator-(const Lanes& a, const Lanes& b) { return a.v - b.v; }
TALUS_INLINE Lanes operator*(const Lanes& a, const Lanes& b) { return a.v * b.v; }
TALUS_INLINE Lanes operator/(const Lanes& a, const Lanes& b) { return a.v / b.v; }
TALUS_INLINE Lanes operator-(const Lanes& a) { return -a.v; }
TALUS_INLINE Mask operator>(const Lanes& a, const Lanes& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ)};
}
TALUS_INLINE Mask operator<(const Lanes& a, const Lanes& b) { return b > a; }
TALUS_INLINE Mask operator<=(const Lanes& a, const Lanes& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ)};
}
TALUS_INLINE Lanes Select(Mask m, const Lanes& a, const Lanes& b) {
  return _mm512_mask_blend_pd(m.bits, b.v, a.v);
}
TALUS_INLINE Lanes Min(const Lanes& a, const Lanes& b) { return _mm512_min_pd(a.v, b.v); }
TALUS_INLINE Lanes Max(const Lanes& a, const Lanes& b) { return _mm512_max_pd(a.v, b.v); }
TALUS_INLINE Lanes Abs(const Lanes& a) { return _mm512_abs_pd(a.v); }
TALUS_INLINE Lanes Sqrt(const Lanes& a) { return _mm512_sqrt_pd(a.v); }

// 14 bits, doubled twice by Newton's y ← y + y (1 − x y²)/2. The square root and the division of
// this width take several times as long.
TALUS_INLINE Lanes Rsqrt(const Lanes& a) {
  const __m512d half = _mm512_set1_pd(0.5);
  const __m512d one = _mm512_set1_pd(1.0);
  __m512d y = _mm512_rsqrt14_pd(a.v);
  for (int step = 0; step < 2; ++step) {
    const __m512d error = _mm512_fnmadd_pd(a.v * y, y, one);
    y = _mm512_fmadd_pd(y * half, error, y);
  }
  return y;
}

// x, y, z, w of eight rows of four doubles.
struct Quads {
  Lanes x, y, z, w;
};

// Row k starts at base + stride · index[k]. Loads and shuffles take a third of a gather's time.
TALUS_INLINE Quads LoadQuads(const double* base, std::int64_t stride, const std::int32_t* index) {
  const auto rows = [&](int k, int m) __attribute__((always_inline)) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(base + stride * index[k])),
                              _mm256_loadu_pd(base + stride * index[m]), 1);
  };
  const __m512d a = rows(0, 2), b = rows(1, 3), c = rows(4, 6), d = rows(5, 7);
  const __m512d low_xz = _mm512_unpacklo_pd(a, b), low_yw = _mm512_unpackhi_pd(a, b);
  const __m512d high_xz = _mm512_unpacklo_pd(c, d), high_yw = _mm512_unpackhi_pd(c, d);
  return {_mm512_shuffle_f64x2(low_xz, high_xz, 0x88), _mm512_shuffle_f64x2(low_yw, high_yw, 0x88),
          _mm512_shuffle_f64x2(low_xz, high_xz, 0xdd), _mm512_shuffle_f64x2(low_yw, high_yw, 0xdd)};
}

// The way back, in pairs of rows: {rows 0 and 2, 4 and 6, 1 and 3, 5 and 7}.
struct QuadPairs {
  __m512d rows02, rows46, rows13, rows57;
};
TALUS_INLINE QuadPairs Transpose(const Quads& q) {
  const __m512d xy_even = _mm512_unpacklo_pd(q.x.v, q.y.v);
  const __m512d xy_odd = _mm512_unpackhi_pd(q.x.v, q.y.v);
  const __m512d zw_even = _mm512_unpacklo_pd(q.z.v, q.w.v);
  const __m512d zw_odd = _mm512_unpackhi_pd(q.z.v, q.w.v);
  const __m512i low = _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0);
  const __m512i high = _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
  return {
      _mm512_permutex2var_pd(xy_even, low, zw_even), _mm512_permutex2var_pd(xy_even, high, zw_even),
      _mm512_permutex2var_pd(xy_odd, low, zw_odd), _mm512_permutex2var_pd(xy_odd, high, zw_odd)};
}

TALUS_INLINE void StoreQuads(const Quads& q, double* base, std::int64_t stride) {
  const QuadPairs p = Transpose(q);
  const auto store = [&](int k, __m512d pair) __attribute__((always_inline)) {
    _mm256_storeu_pd(base + stride * k, _mm512_castpd512_pd256(pair));
    _mm256_storeu_pd(base + stride * (k + 2), _mm512_extractf64x4_pd(pair, 1));
  };
  store(0, p.rows02);
  store(4, p.rows46);
  store(1, p.rows13);
  store(5, p.rows57);
}

// rows[index[k] − offset] += or −= (f, t) of lane k, one lane after the other: two lanes may name
// one row. A row is {fx, fy, fz, -, tx, ty, tz, -}.
template <bool kSubtract>
TALUS_INLINE void AddToRows(const Vector<Lanes>& f, const Vector<Lanes>& t, double* rows,
                            const std::int32_t* index, std::int64_t offset) {
  const Lanes zero(0.0);
  const QuadPairs fs = Transpose({f.x, f.y, f.z, zero});
  const QuadPairs ts = Transpose({t.x, t.y, t.z, zero});
  const auto add = [&](int k, __m512d row) __attribute__((always_inline)) {
    double* to = rows + 8 * (index[k] - offset);
    const __m512d old = _mm512_loadu_pd(to);
    _mm512_storeu_pd(to, kSubtract ? old - row : old + row);
  };
  add(0, _mm512_shuffle_f64x2(fs.rows02, ts.rows02, 0x44));
  add(1, _mm512_shuffle_f64x2(fs.rows13, ts.rows13, 0x44));
  add(2, _mm512_shuffle_f64x2(fs.rows02, ts.rows02, 0xee));
  add(3, _mm512_shuffle_f64x2(fs.rows13, ts.rows13, 0xee));
  add(4, _mm512_shuffle_f64x2(fs.rows46, ts.rows46, 0x44));
  add(5, _mm512_shuffle_f64x2(fs.rows57, ts.rows57, 0x44));
  add(6, _mm512_shuffle_f64x2(fs.rows46, ts.rows46, 0xee));
  add(7, _mm512_shuffle_f64x2(fs.rows57, ts.rows57, 0xee));
}

}  // namespace talus::engine::TALUS_TARGET
