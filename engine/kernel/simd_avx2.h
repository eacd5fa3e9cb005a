// Four doubles or eight floats in an AVX register. Included by simd.h only.
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

struct FloatMask {
  __m256 v;
};
TALUS_INLINE FloatMask operator&(FloatMask a, FloatMask b) { return {_mm256_and_ps(a.v, b.v)}; }
TALUS_INLINE unsigned Bits(FloatMask a) { return static_cast<unsigned>(_mm256_movemask_ps(a.v)); }

struct Floats {
  static constexpr int kWidth = 8;
  __m256 v;

  Floats() = default;
  TALUS_INLINE Floats(__m256 value) : v(value) {}
  TALUS_INLINE explicit Floats(float value) : v(_mm256_set1_ps(value)) {}
  TALUS_INLINE explicit Floats(double value) : Floats(static_cast<float>(value)) {}

  static TALUS_INLINE Floats Load(const float* from) { return _mm256_loadu_ps(from); }
  TALUS_INLINE void Store(float* to) const { _mm256_storeu_ps(to, v); }
  static TALUS_INLINE Floats Iota() { return _mm256_set_ps(7, 6, 5, 4, 3, 2, 1, 0); }
};

TALUS_INLINE Floats operator+(const Floats& a, const Floats& b) { return a.v + b.v; }
TALUS_INLINE Floats operator-(const Floats& a, const Floats& b) { return a.v - b.v; }
TALUS_INLINE Floats operator*(const Floats& a, const Floats& b) { return a.v * b.v; }
TALUS_INLINE Floats operator/(const Floats& a, const Floats& b) { return a.v / b.v; }
TALUS_INLINE Floats operator-(const Floats& a) { return -a.v; }
TALUS_INLINE FloatMask operator>(const Floats& a, const Floats& b) {
  return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)};
}
TALUS_INLINE FloatMask operator<(const Floats& a, const Floats& b) { return b > a; }
TALUS_INLINE Floats Select(FloatMask m, const Floats& a, const Floats& b) {
  return _mm256_blendv_ps(b.v, a.v, m.v);
}
TALUS_INLINE Floats Abs(const Floats& a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v); }
TALUS_INLINE Floats Sqrt(const Floats& a) { return _mm256_sqrt_ps(a.v); }
TALUS_INLINE Floats Rsqrt(const Floats& a) { return _mm256_set1_ps(1.0f) / _mm256_sqrt_ps(a.v); }

// Four lanes each.
TALUS_INLINE Floats Narrow(const Lanes& low, const Lanes& high) {
  return _mm256_set_m128(_mm256_cvtpd_ps(high.v), _mm256_cvtpd_ps(low.v));
}
TALUS_INLINE FloatMask Join(Mask low, Mask high) {
  const __m256 mixed = _mm256_shuffle_ps(_mm256_castpd_ps(low.v), _mm256_castpd_ps(high.v), 0x88);
  return {_mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(mixed), 0xd8))};
}

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

// Two quads of floats of eight rows of eight: what stands first in the rows, and what stands last.
struct FloatQuads {
  Floats x, y, z, w;
};
struct FloatRows {
  FloatQuads first, last;
};

// Rows and columns of the two 4 × 4 squares that stand side by side in a, b, c, d.
struct FourFloats {
  __m256 a, b, c, d;
};
TALUS_INLINE FourFloats TransposeSquares(const FourFloats& m) {
  const auto pd = [](__m256 v) __attribute__((always_inline)) { return _mm256_castps_pd(v); };
  const auto ps = [](__m256d v) __attribute__((always_inline)) { return _mm256_castpd_ps(v); };
  const __m256d ab_low = pd(_mm256_unpacklo_ps(m.a, m.b)),
                cd_low = pd(_mm256_unpacklo_ps(m.c, m.d));
  const __m256d ab_high = pd(_mm256_unpackhi_ps(m.a, m.b));
  const __m256d cd_high = pd(_mm256_unpackhi_ps(m.c, m.d));
  return {ps(_mm256_unpacklo_pd(ab_low, cd_low)), ps(_mm256_unpackhi_pd(ab_low, cd_low)),
          ps(_mm256_unpacklo_pd(ab_high, cd_high)), ps(_mm256_unpackhi_pd(ab_high, cd_high))};
}

// Row k starts at base + 8 · index[k].
TALUS_INLINE FloatRows LoadRows(const float* base, const std::int32_t* index) {
  const auto row = [&](int k) __attribute__((always_inline)) {
    return _mm256_loadu_ps(base + 8 * index[k]);
  };
  const FourFloats p = TransposeSquares({row(0), row(1), row(2), row(3)});
  const FourFloats q = TransposeSquares({row(4), row(5), row(6), row(7)});
  return {{_mm256_permute2f128_ps(p.a, q.a, 0x20), _mm256_permute2f128_ps(p.b, q.b, 0x20),
           _mm256_permute2f128_ps(p.c, q.c, 0x20), _mm256_permute2f128_ps(p.d, q.d, 0x20)},
          {_mm256_permute2f128_ps(p.a, q.a, 0x31), _mm256_permute2f128_ps(p.b, q.b, 0x31),
           _mm256_permute2f128_ps(p.c, q.c, 0x31), _mm256_permute2f128_ps(p.d, q.d, 0x31)}};
}

// Row k starts at base + 4 · index[k].
TALUS_INLINE FloatQuads LoadSpots(const float* base, const std::int32_t* index) {
  const auto rows = [&](int k) __attribute__((always_inline)) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(base + 4 * index[k])),
                                _mm_loadu_ps(base + 4 * index[k + 4]), 1);
  };
  const FourFloats q = TransposeSquares({rows(0), rows(1), rows(2), rows(3)});
  return {q.a, q.b, q.c, q.d};
}

// Row k of q times `scale`, rounded, to to + 4 k.
TALUS_INLINE void StoreSpots(const Quads& q, double scale, float* to) {
  const QuadRows rows = Transpose(q);
  for (int k = 0; k < 4; ++k) {
    _mm_storeu_ps(to + 4 * k, _mm256_cvtpd_ps(rows.row[k] * _mm256_set1_pd(scale)));
  }
}

// Row k of v and w, rounded, to to + 8 k.
TALUS_INLINE void StoreRounded(const Quads& v, const Quads& w, float* to) {
  const auto both = [](const Lanes& a, const Lanes& b) __attribute__((always_inline)) {
    return Narrow(a, b).v;
  };
  const FourFloats rows =
      TransposeSquares({both(v.x, w.x), both(v.y, w.y), both(v.z, w.z), both(v.w, w.w)});
  _mm256_storeu_ps(to, rows.a);
  _mm256_storeu_ps(to + 8, rows.b);
  _mm256_storeu_ps(to + 16, rows.c);
  _mm256_storeu_ps(to + 24, rows.d);
}

// rows[index[k] − offset] += or −= (f, t) of lane k, one lane after the other: two lanes may name
// one row. A row is {fx, fy, fz, -, tx, ty, tz, -}.
template <bool kSubtract>
TALUS_INLINE void AddToRows(const Vector<Floats>& f, const Vector<Floats>& t, double* rows,
                            const std::int32_t* index, std::int64_t offset) {
  const __m256 zero = _mm256_setzero_ps();
  const FourFloats fs = TransposeSquares({f.x.v, f.y.v, f.z.v, zero});
  const FourFloats ts = TransposeSquares({t.x.v, t.y.v, t.z.v, zero});
  const auto add_part = [](double* to, __m128 part) __attribute__((always_inline)) {
    const __m256d old = _mm256_loadu_pd(to), more = _mm256_cvtps_pd(part);
    _mm256_storeu_pd(to, kSubtract ? old - more : old + more);
  };
  const auto add = [&](int k, __m256 fk, __m256 tk) __attribute__((always_inline)) {
    double* to = rows + 8 * (index[k] - offset);
    add_part(to, _mm256_castps256_ps128(fk));
    add_part(to + 4, _mm256_castps256_ps128(tk));
  };
  const auto high = [](__m256 v) __attribute__((always_inline)) {
    return _mm256_castps128_ps256(_mm256_extractf128_ps(v, 1));
  };
  add(0, fs.a, ts.a);
  add(1, fs.b, ts.b);
  add(2, fs.c, ts.c);
  add(3, fs.d, ts.d);
  add(4, high(fs.a), high(ts.a));
  add(5, high(fs.b), high(ts.b));
  add(6, high(fs.c), high(ts.c));
  add(7, high(fs.d), high(ts.d));
}

}  // namespace talus::engine::TALUS_TARGET
