// Shapes, and walls that move.
#include <gtest/gtest.h>

#include "base/random.h"
#include "engine/kernel/shapes.h"
#include "tests/engine/scenes.h"

namespace talus::engine {
namespace wall_test {

constexpr double kRadius = 2.0, kLength = 3.0, kSecond = 0.8;

// Points of a shape along z with its base at the origin, densely: a grid in height or radius, and
// in angle.
std::vector<Vec3> Sample(ShapeKind kind, int count) {
  std::vector<Vec3> points;
  const auto ring = [&](double rho, double z) {
    for (int k = 0; k < 4 * count; ++k) {
      const double angle = 2 * std::numbers::pi * k / (4 * count);
      points.push_back({rho * std::cos(angle), rho * std::sin(angle), z});
    }
  };
  for (int k = 0; k <= count; ++k) {
    const double share = static_cast<double>(k) / count;
    if (kind == ShapeKind::kAnnulus) ring(kSecond + (kRadius - kSecond) * share, 0);
    if (kind == ShapeKind::kCone) ring(kRadius + (kSecond - kRadius) * share, kLength * share);
    if (kind == ShapeKind::kAnnulus || kind == ShapeKind::kCone) continue;
    if (kind != ShapeKind::kDisc) ring(kRadius, kLength * share);
    if (kind == ShapeKind::kDisc || kind == ShapeKind::kSolidCylinder) ring(kRadius * share, 0);
    if (kind == ShapeKind::kSolidCylinder) ring(kRadius * share, kLength);
  }
  return points;
}

class ShapeTest : public ::testing::TestWithParam<ShapeKind> {};

TEST_P(ShapeTest, NearestPointIsTheNearestOfManySamples) {
  const ShapeKind kind = GetParam();
  const WallView wall{.kind = kind,
                      .point = {0, 0, 0},
                      .axis = {0, 0, 1},
                      .across = {1, 0, 0},
                      .radius = kRadius,
                      .length = kind == ShapeKind::kDisc ? 0 : kLength,
                      .velocity = {},
                      .second = kSecond};
  const auto samples = Sample(kind, 100);
  for (int i = 0; i < 300; ++i) {
    base::Random random(3, base::Stream("wall_test"), i);
    const Vec3 x{random.Uniform(-4, 4), random.Uniform(-4, 4), random.Uniform(-3, 6)};
    const bool inside = std::hypot(x.x, x.y) < kRadius && x.z > 0 && x.z < kLength;
    if (kind == ShapeKind::kSolidCylinder && inside) continue;  // no sphere's centre gets there
    const NearestPoint<double> nearest = Nearest(wall, Vector<double>{x.x, x.y, x.z});
    double least = 1e9;
    Vec3 at;
    for (const Vec3& s : samples) {
      if (const double d = base::Norm(s - x); d < least) {
        least = d;
        at = s;
      }
    }
    // Samples are 0.03 apart, so their distance is at most 0.02²/distance too large.
    EXPECT_LE(nearest.distance, least + 1e-12);
    EXPECT_GT(nearest.distance, least - 4e-4 / std::max(least, 0.01));
    const Vec3 foot =
        x + nearest.distance * Vec3{nearest.normal.x, nearest.normal.y, nearest.normal.z};
    if (std::hypot(x.x, x.y) > 0.3) {
      EXPECT_LT(base::Norm(foot - at), 0.1);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, ShapeTest,
                         ::testing::Values(ShapeKind::kDisc, ShapeKind::kOpenCylinder,
                                           ShapeKind::kSolidCylinder, ShapeKind::kAnnulus,
                                           ShapeKind::kCone));

TEST(Shapes, ARectangleEndsAtItsEdgesAndCorners) {
  const WallView wall{.kind = ShapeKind::kRectangle,
                      .point = {1, 1, 1},
                      .axis = {0, 0, 1},
                      .across = {0.6, 0.8, 0},
                      .radius = 3,
                      .length = 0,
                      .velocity = {},
                      .second = 2};
  const auto nearest = [&](double u, double v, double h) {  // along the edge, across it, above
    return Nearest(wall, Vector<double>{1 + 0.6 * u - 0.8 * v, 1 + 0.8 * u + 0.6 * v, 1 + h});
  };
  EXPECT_NEAR(nearest(2.9, -1.9, 0.5).distance, 0.5, 1e-14);
  EXPECT_NEAR(nearest(2.9, -1.9, 0.5).normal.z, -1, 1e-14);
  EXPECT_NEAR(nearest(2.9, -1.9, -0.5).normal.z, 1, 1e-14);
  EXPECT_NEAR(nearest(6, 1, 4).distance, 5, 1e-14);            // an edge
  EXPECT_NEAR(nearest(-3 - 2, -2 - 3, 6).distance, 7, 1e-14);  // a corner
  EXPECT_NEAR(nearest(-5, -5, 6).normal.z, -6.0 / 7, 1e-14);
}

// On the axis of a cone, the side is as far away as its radius there times the cosine of its slope.
TEST(Shapes, OnItsAxisAConeIsAsFarAsItsSlopeSays) {
  const WallView wall{.kind = ShapeKind::kCone,
                      .point = {0, 0, 0},
                      .axis = {0, 0, 1},
                      .across = {1, 0, 0},
                      .radius = 1,
                      .length = 4,
                      .velocity = {},
                      .second = 4};
  const auto nearest = Nearest(wall, Vector<double>{0, 0, 2});
  EXPECT_NEAR(nearest.distance, 2.5 * 0.8, 1e-14);
  EXPECT_NEAR(nearest.normal.x, 0.8, 1e-14);
  EXPECT_NEAR(nearest.normal.z, -0.6, 1e-14);
}

TEST(Shapes, APlaneIsSolidBehind) {
  const WallView plane{.kind = ShapeKind::kPlane,
                       .point = {0, 0, 1},
                       .axis = {0, 0, 1},
                       .across = {1, 0, 0},
                       .radius = 0,
                       .length = 0,
                       .velocity = {}};
  EXPECT_EQ(Nearest(plane, Vector<double>{5, 5, 3}).distance, 2);
  EXPECT_EQ(Nearest(plane, Vector<double>{5, 5, 0}).distance, -1);
  EXPECT_EQ(Nearest(plane, Vector<double>{5, 5, 0}).normal.z, -1);
}

TEST(Shapes, PointsOnTheAxisHaveTheDistanceOfTheirNeighbours) {
  for (const ShapeKind kind :
       {ShapeKind::kDisc, ShapeKind::kOpenCylinder, ShapeKind::kSolidCylinder}) {
    const WallView wall{.kind = kind,
                        .point = {},
                        .axis = {0, 0, 1},
                        .across = {1, 0, 0},
                        .radius = 1,
                        .length = 2,
                        .velocity = {}};
    for (const double z : {-1.0, 3.0, 0.5}) {
      if (kind == ShapeKind::kSolidCylinder && z == 0.5) continue;  // inside
      const auto on = Nearest(wall, Vector<double>{0, 0, z});
      const auto beside = Nearest(wall, Vector<double>{1e-9, 0, z});
      EXPECT_NEAR(on.distance, beside.distance, 1e-8);
      EXPECT_NEAR(Dot(on.normal, on.normal), 1, 1e-14);
    }
  }
}

Material Rough() {
  Material material = testing::Glass();
  material.sliding_friction = 0.3;
  return material;
}

// From rest at the overlap that carries `load`, a sphere of 1 mm.
double RestOverlap(const Material& m, double load) {
  const double r = 1e-3;
  return std::pow(load / (4.0 / 3 * MakePairConstants(m, m, {}).y_star * std::sqrt(r)), 2.0 / 3);
}

// Pressed against the inside of a tube that goes up, a grain is carried by friction: μ g in time,
// and once its surface keeps up, at 2/7 of the tube's speed, the rest being spin.
TEST(MovingWall, ALiftedTubeCarriesAGrainByFriction) {
  const double r = 1e-3, lift = 0.2, g = 9.81;
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {g, 0, 0};
  const double overlap = RestOverlap(scene.materials[0], SphereMass(scene.materials[0], r) * g);
  scene.particles = {{.radius = r, .position = {10e-3 - r + overlap, 0, 0}}};
  scene.walls = {{.name = "tube",
                  .shape = OpenCylinder{.base = {0, 0, -0.1}, .radius = 10e-3, .length = 0.2},
                  .motion = {{.time = 0, .velocity = {0, 0, lift}}}}};
  Simulation simulation(scene);
  const double slides_until = 2.0 / 7 * lift / (0.3 * g);
  simulation.Advance(std::llround(0.5 * slides_until / simulation.time_step()));
  // The tangential spring is wound up in the first 1 % of this.
  EXPECT_NEAR(simulation.Particles()[0].velocity.z / (0.3 * g * simulation.time()), 1, 5e-3);
  simulation.Advance(std::llround(3 * slides_until / simulation.time_step()));
  EXPECT_NEAR(simulation.Particles()[0].velocity.z / (2.0 / 7 * lift), 1, 1e-3);
  EXPECT_NEAR(std::get<OpenCylinder>(simulation.Walls()[0].shape).base.z,
              -0.1 + lift * simulation.time(), 1e-12);
}

// With rolling resistance that holds it, a grain rides a moving plate, and stops with it.
TEST(MovingWall, AGrainRidesAMovingPlateAndStopsWithIt) {
  const double r = 1e-3, speed = 0.02;
  Material material = Rough();
  material.rolling_friction = 0.5;
  Scene scene = testing::EmptySpace(material);
  scene.models.rolling = Rolling::kEpsd;
  scene.gravity = {0, 0, -9.81};
  const double overlap = RestOverlap(material, SphereMass(material, r) * 9.81);
  scene.particles = {{.radius = r, .position = {0, 0, r - overlap}}};
  scene.walls = {
      {.name = "plate",
       .shape = Disc{.center = {}, .radius = 20e-3},
       .motion = {{.time = 0, .velocity = {speed, 0, 0}}, {.time = 0.2, .velocity = {}}}}};
  Simulation simulation(scene);
  const auto advance_to = [&](double time) {
    simulation.Advance(std::llround((time - simulation.time()) / simulation.time_step()));
    return simulation.Particles()[0];
  };
  EXPECT_NEAR(advance_to(0.19).velocity.x / speed, 1, 1e-3);
  const Particle rest = advance_to(0.5);
  EXPECT_LT(base::Norm(rest.velocity), 1e-6);
  EXPECT_NEAR(std::get<Disc>(simulation.Walls()[0].shape).center.x, speed * 0.2, speed * 2e-5);
}

// A sphere that rolls to and fro at the bottom of a tube: T = 2π √(7 (R−r)/(5 g)), larger by θ²/16
// for an amplitude θ. A contact that forgot its spring on the curved wall would slide, and swing
// with √(R/g) instead, 15 % faster.
TEST(CurvedWall, ASphereRollsInATubeWithTheKnownPeriod) {
  const double r = 1e-3, big = 10e-3, g = 9.81, theta = 0.1;
  Material material = Rough();
  material.youngs_modulus = 1e8;
  Scene scene = testing::EmptySpace(material);
  scene.gravity = {0, 0, -g};
  const double arm = big - r;
  scene.particles = {{.radius = r, .position = {arm * std::sin(theta), 0, -arm * std::cos(theta)}}};
  scene.walls = {{.name = "tube",
                  .shape = OpenCylinder{
                      .base = {0, -0.05, 0}, .axis = {0, 1, 0}, .radius = big, .length = 0.1}}};
  Simulation simulation(scene);
  std::vector<double> crossings;
  double before = 1;
  while (crossings.size() < 3 && simulation.time() < 1) {
    simulation.Advance(20);
    const double x = simulation.Particles()[0].position.x;
    if (x * before < 0) crossings.push_back(simulation.time());
    before = x;
  }
  ASSERT_EQ(crossings.size(), 3u);
  const double period =
      2 * std::numbers::pi * std::sqrt(7 * arm / (5 * g)) * (1 + theta * theta / 16);
  EXPECT_NEAR((crossings[2] - crossings[0]) / period, 1, 5e-3);
}

TEST(Walls, ARemovedWallTouchesNothing) {
  Scene scene = testing::EmptySpace(Rough());
  scene.gravity = {0, 0, -9.81};
  scene.walls = {testing::Floor()};
  scene.particles = {{.radius = 1e-3, .position = {0, 0, 1e-3}}};
  Simulation simulation(scene);
  simulation.Advance(500);
  EXPECT_EQ(simulation.Contacts().size(), 1u);
  simulation.RemoveWall(0);
  const double speed = simulation.Particles()[0].velocity.z, time = simulation.time();
  simulation.Advance(500);
  EXPECT_TRUE(simulation.Contacts().empty());
  EXPECT_NEAR(simulation.Particles()[0].velocity.z, speed - 9.81 * (simulation.time() - time),
              1e-6);
}

}  // namespace wall_test
}  // namespace talus::engine
