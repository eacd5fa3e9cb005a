#include "engine/scene/wall_spec.h"

#include <cmath>

#include "engine/bodies/wall_motion.h"

namespace talus::engine {
namespace {

// The keys of a size that a shape has; it must have them and no others.
struct ShapeKeys {
  bool diameter = false, length = false, inner = false, end = false, sides = false;
};

ShapeKeys KeysOf(WallKind shape) {
  switch (shape) {
    case WallKind::kPlane:
      return {};
    case WallKind::kDisc:
      return {.diameter = true};
    case WallKind::kOpenCylinder:
    case WallKind::kSolidCylinder:
      return {.diameter = true, .length = true};
    case WallKind::kAnnulus:
      return {.diameter = true, .inner = true};
    case WallKind::kRectangle:
      return {.sides = true};
    case WallKind::kCone:
      return {.diameter = true, .length = true, .end = true};
  }
  return {};
}

Vec3 EdgeOf(const WallSpec& spec, const Vec3& normal) {
  const Vec3 other = std::abs(normal.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 edge = spec.edge.value_or(other);
  const Vec3 across = edge - Dot(edge, normal) * normal;
  return across / Norm(across);
}

void ValidateSizes(const WallSpec& spec, base::Problems& problems) {
  const auto check = [&](const char* key, const std::optional<double>& value, bool needed,
                         bool may_be_zero = false) {
    problems.Require(value.has_value() || !needed, key, "is missing");
    problems.Require(!value || needed, key, "does not belong to this shape; remove it");
    if (!value) return;
    const bool good = may_be_zero ? *value >= 0 : *value > 0;
    problems.Require(good && std::isfinite(*value), key, *value,
                     may_be_zero ? "must not be negative" : "must be positive");
  };
  const ShapeKeys keys = KeysOf(spec.shape);
  check("diameter", spec.diameter, keys.diameter, keys.end);
  check("length", spec.length, keys.length);
  check("inner_diameter", spec.inner_diameter, keys.inner);
  check("end_diameter", spec.end_diameter, keys.end, true);
  check("width", spec.width, keys.sides);
  check("height", spec.height, keys.sides);
  problems.Require(!spec.edge || keys.sides, "edge", "does not belong to this shape; remove it");
  if (spec.edge) {
    problems.Require(
        base::IsFinite(*spec.edge) && Norm(Cross(*spec.edge, spec.direction)) >
                                          1e-6 * Norm(*spec.edge) * Norm(spec.direction),
        "edge", "must be finite, not zero, and not parallel to direction");
  }
  if (keys.inner && spec.inner_diameter && spec.diameter) {
    problems.Require(*spec.inner_diameter < *spec.diameter, "inner_diameter", *spec.inner_diameter,
                     "must be below diameter");
  }
  if (keys.end && spec.end_diameter && spec.diameter) {
    problems.Require(*spec.end_diameter > 0 || *spec.diameter > 0, "diameter", *spec.diameter,
                     "and end_diameter must not both be 0");
  }
}

std::vector<MotionStep> BuildMotion(const WallSpec& spec, const Vec3& gravity) {
  if (spec.taps) {
    return TapMotion({.start = spec.taps->start,
                      .count = spec.taps->count,
                      .height = spec.taps->height,
                      .interval = spec.taps->interval,
                      .gravity = gravity});
  }
  std::vector<MotionStep> motion;
  for (const MotionSpec& step : spec.motion) {
    motion.push_back({step.time, step.velocity, step.acceleration, step.angular_velocity});
  }
  return motion;
}

constexpr int kMostTaps = 100'000;  // no device taps so often

void ValidateTaps(const TapSpec& taps, base::Problems& problems) {
  problems.Require(taps.start >= 0 && std::isfinite(taps.start), "taps.start", taps.start,
                   "must not be negative");
  problems.RequireFromTo("taps.count", taps.count, 1, kMostTaps);
  problems.RequirePositive("taps.height", taps.height);
  problems.RequirePositive("taps.interval", taps.interval);
}

WallShape BuildShape(const WallSpec& spec) {
  const Vec3 unit = spec.direction / Norm(spec.direction);
  const double radius = spec.diameter.value_or(0) / 2;
  const double length = spec.length.value_or(0);
  switch (spec.shape) {
    case WallKind::kPlane:
      return Plane{.point = spec.position, .normal = unit};
    case WallKind::kDisc:
      return Disc{.center = spec.position, .normal = unit, .radius = radius};
    case WallKind::kOpenCylinder:
      return OpenCylinder{.base = spec.position, .axis = unit, .radius = radius, .length = length};
    case WallKind::kSolidCylinder:
      return SolidCylinder{.base = spec.position, .axis = unit, .radius = radius, .length = length};
    case WallKind::kAnnulus:
      return Annulus{.center = spec.position,
                     .normal = unit,
                     .inner_radius = *spec.inner_diameter / 2,
                     .radius = radius};
    case WallKind::kRectangle:
      return Rectangle{.center = spec.position,
                       .normal = unit,
                       .edge = EdgeOf(spec, unit),
                       .width = *spec.width,
                       .height = *spec.height};
    case WallKind::kCone:
      return Cone{.base = spec.position,
                  .axis = unit,
                  .radius = radius,
                  .top_radius = *spec.end_diameter / 2,
                  .length = length};
  }
  return {};
}

}  // namespace

void WallSpec::Validate(base::Problems& problems) const {
  const std::size_t before = problems.size();
  ValidateSizes(*this, problems);
  problems.Require(base::IsFinite(position), "position", "must be finite");
  problems.Require(base::IsFinite(direction) && Norm(direction) > 0, "direction",
                   "must be finite and not zero");
  if (taps) ValidateTaps(*taps, problems);
  if (problems.size() > before) return;  // a motion of what is out of range may have no end
  // Taps depend on gravity, and are the scene's to check.
  if (!taps) ValidateMotion(BuildMotion(*this, {}), problems);
  problems.Require(!taps || motion.empty(), "taps", "excludes motion; give one of the two");
  problems.Require(!pivot || base::IsFinite(*pivot), "pivot", "must be finite");
  problems.Require(!removed_at || *removed_at > 0, "removed_at", removed_at.value_or(0),
                   "must be positive");
}

Wall WallSpec::Build(int material_index, const Vec3& gravity) const {
  return {.name = name,
          .shape = BuildShape(*this),
          .material = material_index,
          .motion = BuildMotion(*this, gravity),
          .pivot = pivot,
          .removal_time = removed_at};
}

}  // namespace talus::engine
