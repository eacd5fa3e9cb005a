// From a point to the nearest point of a wall's shape.
//
//   h = (x − p)·a        r = (x − p) − h a        ρ = |r|
//
// with p, a the point and normal, or base and axis, of the shape. Disc and cylinders take h and ρ
// to the nearest value that lies on them. An annulus does so with ρ between its radii; of a cone
// the nearest point of the line from (ρ, h) = (R₀, 0) to (R₁, L) is taken; a rectangle clamps the
// two parts of r along its edges. On the axis of an open cylinder all points are as near: there the
// one across is taken, by way of a radial part too small to matter anywhere else.
#pragma once

#include "engine/kernel/kernel.h"
#include "engine/laws/contact.h"

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

// Unit vector and length of the way to the wall. In place of 0/0 it is against the axis.
template <class V>
TALUS_INLINE NearestPoint<V> FromOffset(const Vector<V>& offset, const Vector<V>& axis) {
  const V square = Dot(offset, offset);
  const auto apart = square > V(0.0);
  const V inverse = Rsqrt(Select(apart, square, V(1.0)));
  return {Select(apart, inverse * offset, -axis), square * inverse};
}

// The nearest point of a rectangle, an annulus, a cone. Not inlined: the other shapes must not pay
// for them.
template <class V>
[[gnu::noinline]] NearestPoint<V> NearestOfMore(const WallView& wall, const Vector<V>& from_base) {
  const Vector<V> axis = Broadcast<V>(wall.axis);
  const Vector<V> across = Broadcast<V>(wall.across);
  const V h = Dot(from_base, axis);
  if (wall.kind == ShapeKind::kRectangle) {
    const Vector<V> other = Cross(axis, across);
    const V u = Dot(from_base, across), v = Dot(from_base, other);
    const V beyond_u = u - Max(V(-wall.radius), Min(u, V(wall.radius)));
    const V beyond_v = v - Max(V(-wall.second), Min(v, V(wall.second)));
    return FromOffset(-(h * axis + beyond_u * across + beyond_v * other), axis);
  }
  const Vector<V> radial = from_base - h * axis + V(1e-100) * across;
  const V rho_squared = Max(Dot(radial, radial), V(1e-200));
  const V inverse_rho = Rsqrt(rho_squared);
  const V rho = rho_squared * inverse_rho;
  V nearest_rho, nearest_h;
  if (wall.kind == ShapeKind::kAnnulus) {
    nearest_rho = Max(V(wall.second), Min(rho, V(wall.radius)));
    nearest_h = V(0.0);
  } else {
    const double widening = wall.second - wall.radius;
    const double scale = 1 / (widening * widening + wall.length * wall.length);
    const V along = V(scale * widening) * (rho - V(wall.radius)) + V(scale * wall.length) * h;
    const V share = Max(V(0.0), Min(along, V(1.0)));
    nearest_rho = V(wall.radius) + V(widening) * share;
    nearest_h = V(wall.length) * share;
  }
  const V outwards = (nearest_rho - rho) * inverse_rho;
  return FromOffset((nearest_h - h) * axis + outwards * radial, axis);
}

// The nearest point of a plane, a disc, a cylinder.
template <class V>
TALUS_INLINE NearestPoint<V> NearestOfFew(const WallView& wall, const Vector<V>& x) {
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

template <class V>
TALUS_INLINE NearestPoint<V> Nearest(const WallView& wall, const Vector<V>& x) {
  if (wall.kind < ShapeKind::kAnnulus) return NearestOfFew(wall, x);
  return NearestOfMore(wall, x - Broadcast<V>(wall.point));
}

// The wall where a sphere at x meets it: a body without inverse masses, whose surface moves as the
// wall does there (K2).
template <class V>
TALUS_INLINE Body<V> WallBody(const WallView& wall, const Vector<V>& x,
                              const NearestPoint<V>& nearest) {
  const V zero(0.0);
  Body<V> body{zero, zero, zero, Broadcast<V>(wall.velocity), {zero, zero, zero}};
  if (wall.turns) {
    const Vector<V> arm = x + nearest.distance * nearest.normal - Broadcast<V>(wall.pivot);
    body.angular_velocity = Broadcast<V>(wall.angular_velocity);
    body.velocity = body.velocity + Cross(body.angular_velocity, arm);
  }
  return body;
}

}  // namespace talus::engine
