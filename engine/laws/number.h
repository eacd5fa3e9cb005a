// What a contact law may ask of its numbers, for `double`. The kernels' vector types offer the same
// names, so that one text of each law serves every width.
#pragma once

#include <cmath>

#define TALUS_INLINE inline __attribute__((always_inline))

namespace talus::engine {

TALUS_INLINE double Sqrt(double a) { return std::sqrt(a); }
TALUS_INLINE double Rsqrt(double a) { return 1.0 / std::sqrt(a); }  // 1/√a, inf for 0
TALUS_INLINE double Abs(double a) { return std::fabs(a); }
TALUS_INLINE double Min(double a, double b) { return a < b ? a : b; }
TALUS_INLINE double Max(double a, double b) { return a > b ? a : b; }
TALUS_INLINE double Select(bool mask, double a, double b) { return mask ? a : b; }

// A vector in space of any such number; for `double` beside base::Vec3, because inline functions
// compiled for a wide instruction set must not be shared with the rest of the program.
template <class V>
struct Vector {
  V x, y, z;
};

template <class V>
TALUS_INLINE Vector<V> operator+(const Vector<V>& a, const Vector<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
TALUS_INLINE Vector<V> operator-(const Vector<V>& a, const Vector<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
TALUS_INLINE Vector<V> operator-(const Vector<V>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class V>
TALUS_INLINE Vector<V> operator*(const V& s, const Vector<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V>
TALUS_INLINE V Dot(const Vector<V>& a, const Vector<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
TALUS_INLINE Vector<V> Cross(const Vector<V>& a, const Vector<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class V, class Mask>
TALUS_INLINE Vector<V> Select(const Mask& mask, const Vector<V>& a, const Vector<V>& b) {
  return {Select(mask, a.x, b.x), Select(mask, a.y, b.y), Select(mask, a.z, b.z)};
}
template <class V, class Mask>
TALUS_INLINE Vector<V> OrZero(const Mask& mask, const Vector<V>& a) {
  const V zero(0.0);
  return {Select(mask, a.x, zero), Select(mask, a.y, zero), Select(mask, a.z, zero)};
}

}  // namespace talus::engine
