// Walls as polygons.
#include "experiments/analysis/export/wall_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace talus::analysis {
namespace wall_mesh_test {

using base::Vec3;

// Tilted, so that no axis is taken for another.
const Vec3 kNormal{0.48, -0.6, 0.64};
const Vec3 kCenter{1, 2, 3};

double AreaOf(const WallMesh& mesh) {
  double area = 0;
  for (const std::vector<int>& polygon : mesh.polygons) {
    const auto point = [&](std::size_t i) {
      return mesh.points.at(static_cast<std::size_t>(polygon[i % polygon.size()]));
    };
    Vec3 sum{};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      sum = sum + Cross(point(i) - point(0), point(i + 1) - point(0));
    }
    area += 0.5 * Norm(sum);
  }
  return area;
}

// Distance from the axis through the centre, and along it.
double Radius(const Vec3& p) { return Norm(Cross(p - kCenter, kNormal)); }
double Height(const Vec3& p) { return Dot(p - kCenter, kNormal); }

// The area of a polygon of 64 corners in the circle.
const double kSegments = 64;
double DiscArea(double radius) {
  return kSegments / 2 * std::sin(2 * std::numbers::pi / kSegments) * radius * radius;
}
double Perimeter(double radius) {
  return 2 * kSegments * std::sin(std::numbers::pi / kSegments) * radius;
}

TEST(WallMesh, DiscAndRingLieInTheirPlane) {
  const WallMesh disc = MeshOf(engine::Disc{kCenter, kNormal, 0.2});
  EXPECT_NEAR(AreaOf(disc), DiscArea(0.2), 1e-12);
  const WallMesh ring = MeshOf(engine::Annulus{kCenter, kNormal, 0.1, 0.2});
  EXPECT_NEAR(AreaOf(ring), DiscArea(0.2) - DiscArea(0.1), 1e-12);
  for (const WallMesh* mesh : {&disc, &ring}) {
    for (const Vec3& p : mesh->points) EXPECT_NEAR(Height(p), 0, 1e-12);
  }
  for (const Vec3& p : disc.points) EXPECT_NEAR(Radius(p), 0.2, 1e-12);
}

TEST(WallMesh, ARectangleIsAsWideAlongItsEdge) {
  const Vec3 edge = Cross(kNormal, Vec3{0, 0, 1}) / Norm(Cross(kNormal, Vec3{0, 0, 1}));
  const WallMesh mesh = MeshOf(engine::Rectangle{kCenter, kNormal, edge, 0.4, 0.1});
  EXPECT_NEAR(AreaOf(mesh), 0.04, 1e-12);
  for (const Vec3& p : mesh.points) {
    EXPECT_NEAR(std::abs(Dot(p - kCenter, edge)), 0.2, 1e-12);
    EXPECT_NEAR(Height(p), 0, 1e-12);
  }
}

// Each face of a cone's band is a flat trapezium.
TEST(WallMesh, ConesAndCylindersStandOnTheirBase) {
  const WallMesh cone = MeshOf(engine::Cone{kCenter, kNormal, 0.2, 0.05, 0.3});
  for (const Vec3& p : cone.points) {
    EXPECT_NEAR(Radius(p), 0.2 - 0.15 / 0.3 * Height(p), 1e-12);
  }
  const double slant = std::hypot(0.3, 0.15 * std::cos(std::numbers::pi / kSegments));
  EXPECT_NEAR(AreaOf(cone), (Perimeter(0.2) + Perimeter(0.05)) / 2 * slant, 1e-12);
  const WallMesh open = MeshOf(engine::OpenCylinder{kCenter, kNormal, 0.2, 0.3});
  EXPECT_NEAR(AreaOf(open), Perimeter(0.2) * 0.3, 1e-12);
  const WallMesh closed = MeshOf(engine::SolidCylinder{kCenter, kNormal, 0.2, 0.3});
  EXPECT_NEAR(AreaOf(closed), AreaOf(open) + 2 * DiscArea(0.2), 1e-12);
  double top = 0;
  for (const Vec3& p : closed.points) top = std::max(top, Height(p));
  EXPECT_NEAR(top, 0.3, 1e-12);
}

TEST(WallMesh, APlaneWithoutEndHasNoPolygon) {
  EXPECT_TRUE(MeshOf(engine::Plane{}).polygons.empty());
}

}  // namespace wall_mesh_test
}  // namespace talus::analysis
