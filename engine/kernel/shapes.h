// From a point to the nearest point of a wall's shape.
//
//   h = (x − p)·a        r = (x − p) − h a        ρ = |r|
//
// with p, a the point and normal, or base and axis, of the shape. Disc and cylinders take h and ρ
// to the nearest value that lies on them. On the axis of an open cylinder all points are as near:
// there the one across is taken, by way of a radial part too small to matter anywhere else.
#pragma once

#include "engine/kernel/kernel.h"

namespace talus::engine {

template <class V>
struct NearestPoint {
  Vector<V> normal;  // from the point to the wall, unit vector
  V distance;        // [m]; of a plane signed, negative behind it
};

template <class V>
TALUS_INLINE Vector<V> Broadcast(const double (&a)[3]) {
  return {V(a[0]), V(a[1]), V(a[2])};
}

// Unit vector and length of the way to the wall. In place of 0/0 it is the axis.
template <class V>
TALUS_INLINE NearestPoint<V> FromOffset(const Vector<V>& offset, const Vector<V>& axis) {
  const V square = Dot(offset, offset);
  const auto apart = square > V(0.0);
  const V inverse = Rsqrt(Select(apart, square, V(1.0)));
  return {Select(apart, inverse * offset, -axis), square * inverse};
}

template <class V>
TALUS_INLINE NearestPoint<V> Nearest(const WallView& wall, const Vector<V>& x) {
  const Vector<V> axis = Broadcast<V>(wall.axis);
  const Vector<V> from_base = x - Broadcast<V>(wall.point);
  const V h = Dot(from_base, axis);
  if (wall.kind == ShapeKind::kPlane) return {-axis, h};
  const Vector<V> radial = from_base - h * axis + V(1e-100) * Broadcast<V>(wall.across);
  const V rho_squared = Max(Dot(radial, radial), V(1e-200));
  const V ratio = V(wall.radius) * Rsqrt(rho_squared);  // of the wall's radius to ρ
  const V along = h - Max(V(0.0), Min(h, V(wall.length)));
  const V across = V(1.0) - (wall.kind == ShapeKind::kOpenCylinder ? ratio : Min(ratio, V(1.0)));
  return FromOffset(-(along * axis + across * radial), axis);
}

}  // namespace talus::engine
