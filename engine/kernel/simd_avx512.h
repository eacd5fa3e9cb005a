// Eight doubles or sixteen floats in an AVX-512 register. Included by simd.h only.
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

struct FloatMask {
  __mmask16 bits;
};
TALUS_INLINE FloatMask operator&(FloatMask a, FloatMask b) {
  return {static_cast<__mmask16>(a.bits & b.bits)};
}
TALUS_INLINE unsigned Bits(FloatMask a) { return a.bits; }

struct Floats {
  static constexpr int kWidth = 16;
  __m512 v;

  Floats() = default;
  TALUS_INLINE Floats(__m512 value) : v(value) {}
  TALUS_INLINE explicit Floats(float value) : v(_mm512_set1_ps(value)) {}
  TALUS_INLINE explicit Floats(double value) : Floats(static_cast<float>(value)) {}

  static TALUS_INLINE Floats Load(const float* from) { return _mm512_loadu_ps(from); }
  TALUS_INLINE void Store(float* to) const { _mm512_storeu_ps(to, v); }
  static TALUS_INLINE Floats Iota() {
    return _mm512_set_ps(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
  }
};

TALUS_INLINE Floats operator+(const Floats& a, const Floats& b) { return a.v + b.v; }
TALUS_INLINE Floats operator-(const Floats& a, const Floats& b) { return a.v - b.v; }
TALUS_INLINE Floats operator*(const Floats& a, const Floats& b) { return a.v * b.v; }
TALUS_INLINE Floats operator/(const Floats& a, const Floats& b) { return a.v / b.v; }
TALUS_INLINE Floats operator-(const Floats& a) { return -a.v; }
TALUS_INLINE FloatMask operator>(const Floats& a, const Floats& b) {
  return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ)};
}
TALUS_INLINE FloatMask operator<(const Floats& a, const Floats& b) { return b > a; }
TALUS_INLINE Floats Select(FloatMask m, const Floats& a, const Floats& b) {
  return _mm512_mask_blend_ps(m.bits, b.v, a.v);
}
TALUS_INLINE Floats Abs(const Floats& a) { return _mm512_abs_ps(a.v); }
TALUS_INLINE Floats Sqrt(const Floats& a) { return _mm512_sqrt_ps(a.v); }

// 14 bits, doubled once.
TALUS_INLINE Floats Rsqrt(const Floats& a) {
  const __m512 y = _mm512_rsqrt14_ps(a.v);
  const __m512 error = _mm512_fnmadd_ps(a.v * y, y, _mm512_set1_ps(1.0f));
  return _mm512_fmadd_ps(y * _mm512_set1_ps(0.5f), error, y);
}

// Eight lanes each.
TALUS_INLINE Floats Narrow(const Lanes& low, const Lanes& high) {
  return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(low.v)), _mm512_cvtpd_ps(high.v),
                            1);
}
TALUS_INLINE FloatMask Join(Mask low, Mask high) {
  return {static_cast<__mmask16>(low.bits | high.bits << 8)};
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

// Two quads of floats of sixteen rows of eight: what stands first in the rows, and what stands
// last.
struct FloatQuads {
  Floats x, y, z, w;
};
struct FloatRows {
  FloatQuads first, last;
};

// Rows and columns of the four 4 × 4 squares that stand side by side in a, b, c, d.
struct FourFloats {
  __m512 a, b, c, d;
};
TALUS_INLINE FourFloats TransposeSquares(const FourFloats& m) {
  const auto pd = [](__m512 v) __attribute__((always_inline)) { return _mm512_castps_pd(v); };
  const auto ps = [](__m512d v) __attribute__((always_inline)) { return _mm512_castpd_ps(v); };
  const __m512d ab_low = pd(_mm512_unpacklo_ps(m.a, m.b)),
                cd_low = pd(_mm512_unpacklo_ps(m.c, m.d));
  const __m512d ab_high = pd(_mm512_unpackhi_ps(m.a, m.b));
  const __m512d cd_high = pd(_mm512_unpackhi_ps(m.c, m.d));
  return {ps(_mm512_unpacklo_pd(ab_low, cd_low)), ps(_mm512_unpackhi_pd(ab_low, cd_low)),
          ps(_mm512_unpacklo_pd(ab_high, cd_high)), ps(_mm512_unpackhi_pd(ab_high, cd_high))};
}

// Row k starts at base + 8 · index[k].
TALUS_INLINE FloatRows LoadRows(const float* base, const std::int32_t* index) {
  const auto rows = [&](int k, int m) __attribute__((always_inline)) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(base + 8 * index[k])),
                              _mm256_loadu_ps(base + 8 * index[m]), 1);
  };
  const FourFloats p = TransposeSquares({rows(0, 4), rows(1, 5), rows(2, 6), rows(3, 7)});
  const FourFloats q = TransposeSquares({rows(8, 12), rows(9, 13), rows(10, 14), rows(11, 15)});
  return {{_mm512_shuffle_f32x4(p.a, q.a, 0x88), _mm512_shuffle_f32x4(p.b, q.b, 0x88),
           _mm512_shuffle_f32x4(p.c, q.c, 0x88), _mm512_shuffle_f32x4(p.d, q.d, 0x88)},
          {_mm512_shuffle_f32x4(p.a, q.a, 0xdd), _mm512_shuffle_f32x4(p.b, q.b, 0xdd),
           _mm512_shuffle_f32x4(p.c, q.c, 0xdd), _mm512_shuffle_f32x4(p.d, q.d, 0xdd)}};
}

// Row k starts at base + 4 · index[k].
TALUS_INLINE FloatQuads LoadSpots(const float* base, const std::int32_t* index) {
  const auto row = [&](int k) __attribute__((always_inline)) {
    return _mm_loadu_ps(base + 4 * index[k]);
  };
  const auto rows = [&](int k) __attribute__((always_inline)) {
    const __m256 low = _mm256_insertf128_ps(_mm256_castps128_ps256(row(k)), row(k + 4), 1);
    const __m256 high = _mm256_insertf128_ps(_mm256_castps128_ps256(row(k + 8)), row(k + 12), 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
  };
  const FourFloats q = TransposeSquares({rows(0), rows(1), rows(2), rows(3)});
  return {q.a, q.b, q.c, q.d};
}

// Row k of q times `scale`, rounded, to to + 4 k.
TALUS_INLINE void StoreSpots(const Quads& q, double scale, float* to) {
  const QuadPairs p = Transpose(q);
  const auto store = [&](int k, __m512d pair) __attribute__((always_inline)) {
    const __m256 rounded = _mm512_cvtpd_ps(pair * _mm512_set1_pd(scale));
    _mm_storeu_ps(to + 4 * k, _mm256_castps256_ps128(rounded));
    _mm_storeu_ps(to + 4 * (k + 2), _mm256_extractf128_ps(rounded, 1));
  };
  store(0, p.rows02);
  store(4, p.rows46);
  store(1, p.rows13);
  store(5, p.rows57);
}

// Row k of v and w, rounded, to to + 8 k.
TALUS_INLINE void StoreRounded(const Quads& v, const Quads& w, float* to) {
  const auto both = [](const Lanes& a, const Lanes& b) __attribute__((always_inline)) {
    return Narrow(a, b).v;
  };
  const FourFloats rows =
      TransposeSquares({both(v.x, w.x), both(v.y, w.y), both(v.z, w.z), both(v.w, w.w)});
  // Where row k is: v of rows 0 and 4 stands in the parts 0 and 1, w in 2 and 3.
  const auto store = [&](int k, __m512 pair) __attribute__((always_inline)) {
    const __m512 sorted = _mm512_shuffle_f32x4(pair, pair, 0xd8);
    _mm256_storeu_ps(to + 8 * k, _mm512_castps512_ps256(sorted));
    _mm256_storeu_ps(to + 8 * (k + 4), _mm512_extractf32x8_ps(sorted, 1));
  };
  store(0, rows.a);
  store(1, rows.b);
  store(2, rows.c);
  store(3, rows.d);
}

// rows[index[k] − offset] += or −= (f, t) of lane k, one lane after the other: two lanes may name
// one row. A row is {fx, fy, fz, -, tx, ty, tz, -}.
template <bool kSubtract>
TALUS_INLINE void AddToRows(const Vector<Floats>& f, const Vector<Floats>& t, double* rows,
                            const std::int32_t* index, std::int64_t offset) {
  const __m512 zero = _mm512_setzero_ps();
  const FourFloats fs = TransposeSquares({f.x.v, f.y.v, f.z.v, zero});
  const FourFloats ts = TransposeSquares({t.x.v, t.y.v, t.z.v, zero});
  const auto add = [&](int k, __m256 row) __attribute__((always_inline)) {
    double* to = rows + 8 * (index[k] - offset);
    const __m512d old = _mm512_loadu_pd(to), more = _mm512_cvtps_pd(row);
    _mm512_storeu_pd(to, kSubtract ? old - more : old + more);
  };
  // The parts l and l + 1 of f and t: rows 4 l + k and 4 l + 4 + k.
  const __m512i low = _mm512_set_epi32(23, 22, 21, 20, 7, 6, 5, 4, 19, 18, 17, 16, 3, 2, 1, 0);
  const __m512i high =
      _mm512_set_epi32(31, 30, 29, 28, 15, 14, 13, 12, 27, 26, 25, 24, 11, 10, 9, 8);
  const auto add_two = [&](int k, __m512 fk, __m512 tk, __m512i parts)
      __attribute__((always_inline)) {
    const __m512 two = _mm512_permutex2var_ps(fk, parts, tk);
    add(k, _mm512_castps512_ps256(two));
    add(k + 4, _mm512_extractf32x8_ps(two, 1));
  };
  add_two(0, fs.a, ts.a, low);
  add_two(1, fs.b, ts.b, low);
  add_two(2, fs.c, ts.c, low);
  add_two(3, fs.d, ts.d, low);
  add_two(8, fs.a, ts.a, high);
  add_two(9, fs.b, ts.b, high);
  add_two(10, fs.c, ts.c, high);
  add_two(11, fs.d, ts.d, high);
}

}  // namespace talus::engine::TALUS_TARGET
