#include "engine/wall_set.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace talus::engine {

namespace {

// The parts that all shapes have, under one name.
struct ShapeParts {
  ShapeKind kind;
  Vec3& point;
  Vec3& axis;
  double radius;
  double length;
};

ShapeParts Parts(Plane& s) { return {ShapeKind::kPlane, s.point, s.normal, 0, 0}; }
ShapeParts Parts(Disc& s) { return {ShapeKind::kDisc, s.center, s.normal, s.radius, 0}; }
ShapeParts Parts(OpenCylinder& s) {
  return {ShapeKind::kOpenCylinder, s.base, s.axis, s.radius, s.length};
}
ShapeParts Parts(SolidCylinder& s) {
  return {ShapeKind::kSolidCylinder, s.base, s.axis, s.radius, s.length};
}
ShapeParts Parts(WallShape& shape) {
  return std::visit([](auto& s) { return Parts(s); }, shape);
}

Vec3 Perpendicular(const Vec3& axis) {
  const Vec3 other = std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = Cross(axis, other);
  return across / Norm(across);
}

WallView View(Wall& wall) {
  const ShapeParts s = Parts(wall.shape);
  const Vec3 across = Perpendicular(s.axis);
  return {.kind = s.kind,
          .point = {s.point.x, s.point.y, s.point.z},
          .axis = {s.axis.x, s.axis.y, s.axis.z},
          .across = {across.x, across.y, across.z},
          .radius = s.radius,
          .length = s.length,
          .velocity = {0, 0, 0}};
}

}  // namespace

void ValidateWall(const Wall& wall, int num_materials, base::Problems& problems) {
  WallShape shape = wall.shape;
  const ShapeParts s = Parts(shape);
  problems.Require(base::IsFinite(s.point), "shape", "must be at a finite place");
  problems.Require(base::IsFinite(s.axis) && base::Norm(s.axis) > 0, "shape",
                   "needs a direction (normal or axis) that is not zero");
  if (s.kind != ShapeKind::kPlane) {
    problems.Require(s.radius > 0 && s.radius < 1e100, "shape.radius", s.radius,
                     "must be positive");
  }
  if (s.kind == ShapeKind::kOpenCylinder || s.kind == ShapeKind::kSolidCylinder) {
    problems.Require(s.length > 0 && s.length < 1e100, "shape.length", s.length,
                     "must be positive");
  }
  problems.Require(wall.material >= 0 && wall.material < num_materials, "material",
                   "is not among the scene's materials");
  for (std::size_t i = 0; i < wall.motion.size(); ++i) {
    const MotionStep& step = wall.motion[i];
    const std::string place = "motion[" + std::to_string(i) + "]";
    problems.Require(step.time >= 0 && step.time < 1e100, place + ".time", step.time,
                     "must be a finite time, not negative");
    problems.Require(i == 0 || step.time > wall.motion[i - 1].time, place + ".time", step.time,
                     "must be later than the one before");
    problems.Require(base::IsFinite(step.velocity), place + ".velocity", "must be finite");
  }
}

WallSet::WallSet(std::vector<Wall> walls) : walls_(std::move(walls)), removed_(walls_.size(), 0) {
  for (Wall& wall : walls_) {
    Vec3& axis = Parts(wall.shape).axis;
    axis = axis / base::Norm(axis);
  }
  Refresh();
}

void WallSet::Restore(std::vector<Wall> walls, std::vector<std::uint8_t> removed) {
  walls_ = std::move(walls);
  removed_ = std::move(removed);
  Refresh();
}

void WallSet::Refresh() {
  views_.clear();
  for (Wall& wall : walls_) views_.push_back(View(wall));
}

void WallSet::SetTime(double time, double time_step) {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    Vec3 velocity;
    for (const MotionStep& step : walls_[w].motion) {
      if (step.time <= time + 0.5 * time_step) velocity = step.velocity;
    }
    views_[w].velocity[0] = velocity.x;
    views_[w].velocity[1] = velocity.y;
    views_[w].velocity[2] = velocity.z;
  }
}

void WallSet::Move(double time_step) {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    WallView& view = views_[w];
    Vec3& point = Parts(walls_[w].shape).point;
    point += time_step * Vec3{view.velocity[0], view.velocity[1], view.velocity[2]};
    view.point[0] = point.x;
    view.point[1] = point.y;
    view.point[2] = point.z;
  }
}

double WallSet::MaxSpeed() const {
  double speed = 0;
  for (std::size_t w = 0; w < views_.size(); ++w) {
    if (removed_[w]) continue;
    const WallView& view = views_[w];
    speed = std::max(speed, base::Norm({view.velocity[0], view.velocity[1], view.velocity[2]}));
  }
  return speed;
}

double WallSet::MaxPrescribedSpeed() const {
  double speed = 0;
  for (const Wall& wall : walls_) {
    for (const MotionStep& step : wall.motion) speed = std::max(speed, base::Norm(step.velocity));
  }
  return speed;
}

}  // namespace talus::engine
