// Two doubles or four floats in an SSE2 register: what every x86-64 has. Included by simd.h only.
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

struct FloatMask {
  __m128 v;
};
TALUS_INLINE FloatMask operator&(FloatMask a, FloatMask b) { return {_mm_and_ps(a.v, b.v)}; }
TALUS_INLINE unsigned Bits(FloatMask a) { return static_cast<unsigned>(_mm_movemask_ps(a.v)); }

struct Floats {
  static constexpr int kWidth = 4;
  __m128 v;

  Floats() = default;
  TALUS_INLINE Floats(__m128 value) : v(value) {}
  TALUS_INLINE explicit Floats(float value) : v(_mm_set1_ps(value)) {}
  TALUS_INLINE explicit Floats(double value) : Floats(static_cast<float>(value)) {}

  static TALUS_INLINE Floats Load(const float* from) { return _mm_loadu_ps(from); }
  TALUS_INLINE void Store(float* to) const { _mm_storeu_ps(to, v); }
  static TALUS_INLINE Floats Iota() { return _mm_set_ps(3, 2, 1, 0); }
};

TALUS_INLINE Floats operator+(const Floats& a, const Floats& b) { return a.v + b.v; }
TALUS_INLINE Floats operator-(const Floats& a, const Floats& b) { return a.v - b.v; }
TALUS_INLINE Floats operator*(const Floats& a, const Floats& b) { return a.v * b.v; }
TALUS_INLINE Floats operator/(const Floats& a, const Floats& b) { return a.v / b.v; }
TALUS_INLINE Floats operator-(const Floats& a) { return -a.v; }
TALUS_INLINE FloatMask operator>(const Floats& a, const Floats& b) {
  return {_mm_cmpgt_ps(a.v, b.v)};
}
TALUS_INLINE FloatMask operator<(const Floats& a, const Floats& b) { return b > a; }
TALUS_INLINE Floats Select(FloatMask m, const Floats& a, const Floats& b) {
  return _mm_or_ps(_mm_and_ps(m.v, a.v), _mm_andnot_ps(m.v, b.v));
}
TALUS_INLINE Floats Abs(const Floats& a) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), a.v); }
TALUS_INLINE Floats Sqrt(const Floats& a) { return _mm_sqrt_ps(a.v); }
TALUS_INLINE Floats Rsqrt(const Floats& a) { return _mm_set1_ps(1.0f) / _mm_sqrt_ps(a.v); }

// Two lanes each.
TALUS_INLINE Floats Narrow(const Lanes& low, const Lanes& high) {
  return _mm_movelh_ps(_mm_cvtpd_ps(low.v), _mm_cvtpd_ps(high.v));
}
TALUS_INLINE FloatMask Join(Mask low, Mask high) {
  return {_mm_shuffle_ps(_mm_castpd_ps(low.v), _mm_castpd_ps(high.v), 0x88)};
}

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

// Two quads of floats of four rows of eight: what stands first in the rows, and what stands last.
struct FloatQuads {
  Floats x, y, z, w;
};
struct FloatRows {
  FloatQuads first, last;
};

struct FourFloats {
  __m128 a, b, c, d;
};
TALUS_INLINE FourFloats TransposeSquares(FourFloats m) {
  _MM_TRANSPOSE4_PS(m.a, m.b, m.c, m.d);
  return m;
}

// Row k starts at base + 8 · index[k].
TALUS_INLINE FloatRows LoadRows(const float* base, const std::int32_t* index) {
  const auto quads = [&](int from) __attribute__((always_inline)) {
    const auto row = [&](int k) __attribute__((always_inline)) {
      return _mm_loadu_ps(base + 8 * index[k] + from);
    };
    const FourFloats q = TransposeSquares({row(0), row(1), row(2), row(3)});
    return FloatQuads{q.a, q.b, q.c, q.d};
  };
  return {quads(0), quads(4)};
}

// Row k starts at base + 4 · index[k].
TALUS_INLINE FloatQuads LoadSpots(const float* base, const std::int32_t* index) {
  const auto row = [&](int k) __attribute__((always_inline)) {
    return _mm_loadu_ps(base + 4 * index[k]);
  };
  const FourFloats q = TransposeSquares({row(0), row(1), row(2), row(3)});
  return {q.a, q.b, q.c, q.d};
}

// Row k of q times `scale`, rounded, to to + 4 k.
TALUS_INLINE void StoreSpots(const Quads& q, double scale, float* to) {
  const __m128 xy = Narrow(Lanes(scale) * q.x, Lanes(scale) * q.y).v;  // {x0, x1, y0, y1}
  const __m128 zw = Narrow(Lanes(scale) * q.z, Lanes(scale) * q.w).v;
  _mm_storeu_ps(to, _mm_shuffle_ps(xy, zw, 0x88));
  _mm_storeu_ps(to + 4, _mm_shuffle_ps(xy, zw, 0xdd));
}

// Row k of v and w, rounded, to to + 8 k.
TALUS_INLINE void StoreRounded(const Quads& v, const Quads& w, float* to) {
  const auto both = [](const Lanes& a, const Lanes& b) __attribute__((always_inline)) {
    return Narrow(a, b).v;
  };
  const FourFloats rows =
      TransposeSquares({both(v.x, v.y), both(w.x, w.y), both(v.z, v.w), both(w.z, w.w)});
  // a, b: {v.x, w.x, v.z, w.z} of rows 0 and 1; c, d: {v.y, w.y, v.w, w.w}.
  const auto store = [&](float* row, __m128 even, __m128 odd) __attribute__((always_inline)) {
    const __m128 x = _mm_unpacklo_ps(even, odd), z = _mm_unpackhi_ps(even, odd);
    _mm_storeu_ps(row, _mm_movelh_ps(x, z));
    _mm_storeu_ps(row + 4, _mm_movehl_ps(z, x));
  };
  store(to, rows.a, rows.c);
  store(to + 8, rows.b, rows.d);
}

// rows[index[k] − offset] += or −= (f, t) of lane k, one lane after the other: two lanes may name
// one row. A row is {fx, fy, fz, -, tx, ty, tz, -}.
template <bool kSubtract>
TALUS_INLINE void AddToRows(const Vector<Floats>& f, const Vector<Floats>& t, double* rows,
                            const std::int32_t* index, std::int64_t offset) {
  const __m128 zero = _mm_setzero_ps();
  const FourFloats fs = TransposeSquares({f.x.v, f.y.v, f.z.v, zero});
  const FourFloats ts = TransposeSquares({t.x.v, t.y.v, t.z.v, zero});
  const auto add_part = [](double* to, __m128d more) __attribute__((always_inline)) {
    const __m128d old = _mm_loadu_pd(to);
    _mm_storeu_pd(to, kSubtract ? old - more : old + more);
  };
  const auto add = [&](int k, __m128 fk, __m128 tk) __attribute__((always_inline)) {
    double* to = rows + 8 * (index[k] - offset);
    add_part(to, _mm_cvtps_pd(fk));
    add_part(to + 2, _mm_cvtps_pd(_mm_movehl_ps(fk, fk)));
    add_part(to + 4, _mm_cvtps_pd(tk));
    add_part(to + 6, _mm_cvtps_pd(_mm_movehl_ps(tk, tk)));
  };
  add(0, fs.a, ts.a);
  add(1, fs.b, ts.b);
  add(2, fs.c, ts.c);
  add(3, fs.d, ts.d);
}

}  // namespace talus::engine::TALUS_TARGET
