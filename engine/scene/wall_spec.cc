#include "engine/scene/wall_spec.h"

#include <cmath>

namespace talus::engine {

void WallSpec::Validate(base::Problems& problems) const {
  const auto positive = [&](const char* key, const std::optional<double>& value, bool needed) {
    problems.Require(value.has_value() || !needed, key, "is missing");
    problems.Require(!value || needed, key, "does not belong to this shape; remove it");
    if (value)
      problems.Require(*value > 0 && std::isfinite(*value), key, *value, "must be positive");
  };
  positive("diameter", diameter, shape != WallKind::kPlane);
  positive("length", length, shape == WallKind::kOpenCylinder || shape == WallKind::kSolidCylinder);
  problems.Require(base::IsFinite(position), "position", "must be finite");
  problems.Require(base::IsFinite(direction) && Norm(direction) > 0, "direction",
                   "must be finite and not zero");
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const std::string key = "motion[" + std::to_string(i) + "]";
    problems.Require(i == 0 || motion[i].time > motion[i - 1].time, key + ".time", motion[i].time,
                     "must be after the one before");
    problems.Require(std::isfinite(motion[i].time), key + ".time", "must be finite");
    problems.Require(base::IsFinite(motion[i].velocity), key + ".velocity", "must be finite");
  }
}

Wall WallSpec::Build(int material_index) const {
  Wall wall{.name = name, .shape = {}, .material = material_index, .motion = {}};
  const Vec3 unit = direction / Norm(direction);
  const double radius = diameter.value_or(0) / 2;
  switch (shape) {
    case WallKind::kPlane:
      wall.shape = Plane{.point = position, .normal = unit};
      break;
    case WallKind::kDisc:
      wall.shape = Disc{.center = position, .normal = unit, .radius = radius};
      break;
    case WallKind::kOpenCylinder:
      wall.shape =
          OpenCylinder{.base = position, .axis = unit, .radius = radius, .length = *length};
      break;
    case WallKind::kSolidCylinder:
      wall.shape =
          SolidCylinder{.base = position, .axis = unit, .radius = radius, .length = *length};
      break;
  }
  for (const MotionSpec& step : motion) wall.motion.push_back({step.time, step.velocity});
  return wall;
}

}  // namespace talus::engine
