#include "engine/bodies/wall_set.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/bodies/wall_motion.h"

namespace talus::engine {

namespace {

// The parts that all shapes have, under one name, as of a WallView.
struct ShapeParts {
  ShapeKind kind;
  Vec3& point;
  Vec3& axis;
  double radius = 0;
  double length = 0;
  double second = 0;
  Vec3* edge = nullptr;
};

ShapeParts Parts(Plane& s) { return {ShapeKind::kPlane, s.point, s.normal}; }
ShapeParts Parts(Disc& s) { return {ShapeKind::kDisc, s.center, s.normal, s.radius}; }
ShapeParts Parts(OpenCylinder& s) {
  return {ShapeKind::kOpenCylinder, s.base, s.axis, s.radius, s.length};
}
ShapeParts Parts(SolidCylinder& s) {
  return {ShapeKind::kSolidCylinder, s.base, s.axis, s.radius, s.length};
}
ShapeParts Parts(Annulus& s) {
  return {ShapeKind::kAnnulus, s.center, s.normal, s.radius, 0, s.inner_radius};
}
ShapeParts Parts(Rectangle& s) {
  return {ShapeKind::kRectangle, s.center, s.normal, s.width / 2, 0, s.height / 2, &s.edge};
}
ShapeParts Parts(Cone& s) {
  return {ShapeKind::kCone, s.base, s.axis, s.radius, s.length, s.top_radius};
}
ShapeParts Parts(WallShape& shape) {
  return std::visit([](auto& s) { return Parts(s); }, shape);
}

Vec3 Perpendicular(const Vec3& axis) {
  const Vec3 other = std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = Cross(axis, other);
  return across / Norm(across);
}

void Store(const Vec3& from, double (&to)[3]) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}
Vec3 Load(const double (&from)[3]) { return {from[0], from[1], from[2]}; }

// Farthest that a point of the shape is from its place [m].
double Extent(const ShapeParts& s) {
  if (s.kind == ShapeKind::kRectangle) return std::hypot(s.radius, s.second);
  return std::hypot(std::max(s.radius, s.second), s.length);
}

// Unit vectors, the edge perpendicular to the normal.
void Normalize(const ShapeParts& s) {
  s.axis = s.axis / base::Norm(s.axis);
  if (s.edge == nullptr) return;
  *s.edge -= Dot(*s.edge, s.axis) * s.axis;
  *s.edge = *s.edge / base::Norm(*s.edge);
}

WallView View(Wall& wall) {
  const ShapeParts s = Parts(wall.shape);
  const Vec3 across = s.edge != nullptr ? *s.edge : Perpendicular(s.axis);
  const Vec3 pivot = wall.pivot.value_or(s.point);
  return {.kind = s.kind,
          .point = {s.point.x, s.point.y, s.point.z},
          .axis = {s.axis.x, s.axis.y, s.axis.z},
          .across = {across.x, across.y, across.z},
          .radius = s.radius,
          .length = s.length,
          .velocity = {0, 0, 0},
          .second = s.second,
          .pivot = {pivot.x, pivot.y, pivot.z}};
}

void ValidateSizes(const ShapeParts& s, base::Problems& problems) {
  const auto positive = [&](const char* key, double value) {
    problems.Require(value > 0 && value < 1e100, key, value, "must be positive");
  };
  switch (s.kind) {
    case ShapeKind::kPlane:
      break;
    case ShapeKind::kDisc:
      positive("shape.radius", s.radius);
      break;
    case ShapeKind::kOpenCylinder:
    case ShapeKind::kSolidCylinder:
      positive("shape.radius", s.radius);
      positive("shape.length", s.length);
      break;
    case ShapeKind::kAnnulus:
      positive("shape.inner_radius", s.second);
      problems.Require(s.radius > s.second && s.radius < 1e100, "shape.radius", s.radius,
                       "must be above inner_radius");
      break;
    case ShapeKind::kRectangle:
      positive("shape.width", 2 * s.radius);
      positive("shape.height", 2 * s.second);
      break;
    case ShapeKind::kCone:
      positive("shape.length", s.length);
      problems.Require(s.radius >= 0 && s.second >= 0, "shape.radius", s.radius,
                       "and top_radius must not be negative");
      positive("shape.radius", std::max(s.radius, s.second));
      break;
  }
}

}  // namespace

void ValidateWall(const Wall& wall, int num_materials, base::Problems& problems) {
  WallShape shape = wall.shape;
  const ShapeParts s = Parts(shape);
  problems.Require(base::IsFinite(s.point), "shape", "must be at a finite place");
  problems.Require(base::IsFinite(s.axis) && base::Norm(s.axis) > 0, "shape",
                   "needs a direction (normal or axis) that is not zero");
  ValidateSizes(s, problems);
  if (s.edge != nullptr) {
    problems.Require(base::IsFinite(*s.edge) && base::Norm(Cross(*s.edge, s.axis)) >
                                                    1e-6 * base::Norm(*s.edge) * base::Norm(s.axis),
                     "shape.edge", "must not be zero or parallel to the normal");
  }
  problems.Require(wall.material >= 0 && wall.material < num_materials, "material",
                   "is not among the scene's materials");
  ValidateMotion(wall.motion, problems);
  problems.Require(s.kind != ShapeKind::kPlane || MaxAngularVelocity(wall.motion) == 0, "motion",
                   "turns a plane, which has no end; take a rectangle, or turn the gravity");
  problems.Require(!wall.pivot || base::IsFinite(*wall.pivot), "pivot", "must be finite");
  problems.Require(!wall.removal_time || *wall.removal_time > 0, "removal_time",
                   wall.removal_time.value_or(0), "must be positive");
}

WallSet::WallSet(std::vector<Wall> walls) : walls_(std::move(walls)), removed_(walls_.size(), 0) {
  for (Wall& wall : walls_) Normalize(Parts(wall.shape));
  Refresh();
}

std::string WallSet::NameOf(int wall) const {
  const std::string& name = walls_[static_cast<std::size_t>(wall)].name;
  return name.empty() ? "walls[" + std::to_string(wall) + "]" : "the wall \"" + name + "\"";
}

void WallSet::Restore(std::vector<Wall> walls, std::vector<std::uint8_t> removed,
                      std::vector<Press> presses) {
  walls_ = std::move(walls);
  removed_ = std::move(removed);
  presses_ = std::move(presses);
  Refresh();
}

void WallSet::Refresh() {
  views_.clear();
  for (Wall& wall : walls_) views_.push_back(View(wall));
}

void WallSet::SetTime(double time, double time_step) {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const MeanMotion mean = MotionOver(walls_[w].motion, time, time_step);
    Store(mean.velocity, views_[w].velocity);
    Store(mean.angular_velocity, views_[w].angular_velocity);
    views_[w].turns = mean.angular_velocity != Vec3();
  }
  for (const Press& press : presses_) AddSpeed(press, press.speed);
}

void WallSet::AddSpeed(const Press& press, double speed) {
  for (const int wall : press.walls) {
    WallView& view = views_[wall];
    Store(Load(view.velocity) + speed * press.direction, view.velocity);
  }
}

void WallSet::SetPresses(std::vector<Press> presses) { presses_ = std::move(presses); }

void WallSet::Push(std::span<const double> loads, double time_step) {
  for (std::size_t k = 0; k < presses_.size(); ++k) {
    const double before = presses_[k].speed;
    presses_[k].speed = PushedSpeed(presses_[k], loads[k], time_step);
    AddSpeed(presses_[k], presses_[k].speed - before);
  }
}

void WallSet::Move(double time_step) {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    WallView& view = views_[w];
    if (view.turns) Turn(w, time_step);
    Vec3& point = Parts(walls_[w].shape).point;
    const Vec3 way = time_step * Load(view.velocity);
    point += way;
    Store(point, view.point);
    if (walls_[w].pivot) *walls_[w].pivot += way;
    Store(walls_[w].pivot.value_or(point), view.pivot);
  }
}

void WallSet::Turn(std::size_t wall, double time_step) {
  WallView& view = views_[wall];
  const Vec3 rotation = time_step * Load(view.angular_velocity);
  const Vec3 pivot = Load(view.pivot);
  const ShapeParts s = Parts(walls_[wall].shape);
  s.point = pivot + Turned(s.point - pivot, rotation);
  s.axis = Turned(s.axis, rotation);
  if (s.edge != nullptr) *s.edge = Turned(*s.edge, rotation);
  Normalize(s);
  const WallView now = View(walls_[wall]);
  std::copy_n(now.axis, 3, view.axis);
  std::copy_n(now.across, 3, view.across);
}

bool WallSet::RemoveDue(double time, double time_step) {
  bool any = false;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (!walls_[w].removal_time || removed_[w]) continue;
    if (*walls_[w].removal_time > time + 0.5 * time_step) continue;
    removed_[w] = 1;
    any = true;
  }
  return any;
}

// A point x of the surface moves at v + ω × (x − pivot). Of ω along the axis, only a rectangle's
// place takes notice.
double WallSet::MaxSpeed() const {
  double speed = 0;
  for (std::size_t w = 0; w < views_.size(); ++w) {
    if (removed_[w]) continue;
    const WallView& view = views_[w];
    double wall_speed = base::Norm(Load(view.velocity));
    if (view.turns) {
      WallShape shape = walls_[w].shape;
      const ShapeParts s = Parts(shape);
      const Vec3 omega = Load(view.angular_velocity);
      const Vec3 center = Load(view.velocity) + Cross(omega, s.point - Load(view.pivot));
      const Vec3 tilting = s.edge != nullptr ? omega : Cross(omega, s.axis);
      wall_speed = base::Norm(center) + base::Norm(tilting) * Extent(s);
    }
    speed = std::max(speed, wall_speed);
  }
  return speed;
}

double MaxPassingSpeed(const Wall& wall) {
  WallShape shape = wall.shape;
  const ShapeParts s = Parts(shape);
  Normalize(s);
  const double offset = base::Norm(s.point - wall.pivot.value_or(s.point));
  const auto tilts = [&](const MotionStep& step) {
    return base::Norm(Cross(step.angular_velocity, s.axis));
  };
  const bool keeps_normal = std::ranges::all_of(wall.motion, [&](const MotionStep& step) {
    return tilts(step) == 0 && base::Norm(step.acceleration) == 0;
  });
  const bool is_flat = s.kind == ShapeKind::kPlane || s.kind == ShapeKind::kDisc ||
                       s.kind == ShapeKind::kAnnulus || s.kind == ShapeKind::kRectangle;
  double speed = is_flat && keeps_normal ? 0 : MaxVelocity(wall.motion);
  for (const MotionStep& step : wall.motion) {
    const double along =
        is_flat ? std::abs(Dot(step.velocity, s.axis))
                : base::Norm(step.velocity) + offset * base::Norm(step.angular_velocity);
    speed = std::max(speed, along + (offset + Extent(s)) * tilts(step));
  }
  return speed;
}

double WallSet::MaxPrescribedSpeed() const {
  double speed = 0;
  for (const Wall& wall : walls_) {
    WallShape shape = wall.shape;
    const ShapeParts s = Parts(shape);
    const double reach = base::Norm(s.point - wall.pivot.value_or(s.point)) + Extent(s);
    speed = std::max(speed, MaxVelocity(wall.motion) + reach * MaxAngularVelocity(wall.motion));
  }
  for (const Press& press : presses_) speed = std::max(speed, FreeSpeed(press));
  return speed;
}

}  // namespace talus::engine
