// What single precision costs: the kernels' collisions against the same laws and the same steps in
// double precision, for grains from a micrometre to a centimetre.
#include <gtest/gtest.h>

#include "engine/laws/scalar_law.h"
#include "tests/engine/scenes.h"

namespace talus::engine {
namespace precision_test {

Vector<double> Plain(const Vec3& a) { return {a.x, a.y, a.z}; }
Vec3 Back(const Vector<double>& a) { return {a.x, a.y, a.z}; }

// Two spheres and the steps of the leapfrog (M3), in double precision.
class Reference {
 public:
  explicit Reference(const Scene& scene)
      : spheres_(scene.particles),
        material_(scene.materials[0]),
        pair_(MakePairConstants(material_, material_, scene.models)),
        law_(PickLaw(scene.models)),
        dt_(scene.time_step) {}

  void Advance() {
    Kick(spheres_, history_, dt_);
    for (Particle& p : spheres_) p.position += dt_ * p.velocity;
  }
  // With velocities at the full step.
  std::vector<Particle> Particles() const {
    std::vector<Particle> ahead = spheres_;
    History<double> history = history_;
    Kick(ahead, history, dt_ / 2);
    return ahead;
  }

 private:
  Body<double> BodyOf(const Particle& p) const {
    const double mass = SphereMass(material_, p.radius);
    return {p.radius, 1 / mass, 1 / (0.4 * mass * p.radius * p.radius), Plain(p.velocity),
            Plain(p.angular_velocity)};
  }
  void Kick(std::vector<Particle>& spheres, History<double>& history, double time) const {
    Particle &p = spheres[0], &q = spheres[1];
    const Body<double> i = BodyOf(p), j = BodyOf(q);
    const Vec3 offset = q.position - p.position;
    const double distance = base::Norm(offset), radii = p.radius + q.radius;
    if (radii + pair_.adhesion_gap < distance) {
      history = {};
      return;
    }
    const Contact<double> contact =
        MakeContact(Plain(offset / distance), radii - distance, p.radius * q.radius / radii,
                    p.radius * i.angular_velocity + q.radius * j.angular_velocity, i, j);
    const Response<double> on_i = law_(pair_, contact, dt_, history);
    const Vec3 lever = Back(on_i.lever), rolling = Back(on_i.rolling);
    p.velocity += time * i.inverse_mass * Back(on_i.force);
    q.velocity -= time * j.inverse_mass * Back(on_i.force);
    p.angular_velocity += time * i.inverse_inertia * (p.radius * lever + rolling);
    q.angular_velocity += time * j.inverse_inertia * (q.radius * lever - rolling);
  }

  std::vector<Particle> spheres_;
  Material material_;
  PairConstants pair_;
  ScalarLaw law_;
  double dt_;
  History<double> history_{};
};

struct Case {
  ContactModels models;
  double radius;  // [m]
};

// Two unequal spheres, apart at first, far from the origin, that meet at an angle and with spin.
Scene Meeting(const Case& c) {
  Material material = testing::Glass();
  material.surface_energy = c.models.adhesion == Adhesion::kNone ? 0 : 3e-2 * c.radius;
  Scene scene = testing::EmptySpace(material);
  scene.models = c.models;
  const double speed = 0.1;
  scene.time_step = 0.1 * RayleighTime(material, 0.7 * c.radius);
  const Vec3 far = 50 * c.radius * Vec3{1, -2, 3};
  scene.particles = {
      {.id = 0, .radius = c.radius, .position = far, .velocity = {speed, 0.5 * speed, 0}},
      {.id = 1,
       .radius = 0.7 * c.radius,
       .position = far + 1.702 * c.radius * Vec3{0.96, 0, 0.28},
       .angular_velocity = (speed / c.radius) * Vec3{0.5, 1, 0.3}}};
  return scene;
}

// Single precision rounds to 6e-8. Over a collision that grows to 1e-6 of the speeds (most with
// DMT, whose pull fades within nanometres); a factor of a law that were wrong by 1e-5 would show.
TEST(Precision, CollisionsAreThoseOfDoublePrecision) {
  for (const double radius : {1e-6, 1e-4, 1e-2}) {
    for (const ContactModels& models : testing::AllModels()) {
      SCOPED_TRACE(::testing::Message() << "radius " << radius << ", " << testing::NameOf(models));
      const Scene scene = Meeting({models, radius});
      Reference reference(scene);
      Simulation simulation(scene);
      bool touched = false;
      for (int step = 0; step < 300; ++step) {
        simulation.Advance(1);
        reference.Advance();
        touched |= !simulation.Contacts().empty();
      }
      EXPECT_TRUE(touched);
      const auto a = simulation.Particles(), b = reference.Particles();
      for (int i = 0; i < 2; ++i) {
        EXPECT_LT(base::Norm(a[i].velocity - b[i].velocity), 3e-6 * 0.1);
        EXPECT_LT(radius * base::Norm(a[i].angular_velocity - b[i].angular_velocity), 3e-6 * 0.1);
      }
    }
  }
}

// A sphere above another one, or above a floor, pressed into it by a share of its radius.
struct Pressed {
  bool floor;
  double far;  // from the origin, in radii [-]
  double overlap;
};

Scene PressedSpheres(const Pressed& c) {
  constexpr double radius = 1e-4;
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.materials[0].restitution = 1;
  const Vec3 at = c.far * radius * Vec3{1, -2, c.floor ? 0.0 : 3.0};
  const double height = (c.floor ? 1 : 2) * radius - c.overlap * radius;
  scene.particles = {{.id = 0, .radius = radius, .position = at + Vec3{0, 0, height}}};
  if (c.floor) {
    scene.walls = {testing::Floor()};
  } else {
    scene.particles.push_back({.id = 1, .radius = radius, .position = at});
  }
  return scene;
}

// (N1) in double precision from the positions that the engine gives.
double HertzForce(const std::vector<Particle>& p, const Material& m) {
  const bool floor = p.size() == 1;
  const double distance = p[0].position.z - (floor ? 0 : p[1].position.z);
  const double overlap = (floor ? 1 : 2) * p[0].radius - distance;
  const double r_star = floor ? p[0].radius : p[0].radius / 2;
  return 4.0 / 3 * MakePairConstants(m, m, {}).y_star * std::sqrt(r_star * overlap) * overlap;
}

// From rest and undamped, the first step gives (F₀ + F₁) Δt/2m. Positions in single precision would
// lose an overlap of 1e-6 radii even at the origin; what is left is some roundings of 6e-8.
TEST(Precision, AForceIsRightToSixDigitsHoweverSmallTheOverlap) {
  for (const bool floor : {false, true}) {
    for (const double far : {0.0, 50.0, 1000.0}) {
      for (const double overlap : {1e-6, 1e-4, 1e-2}) {
        SCOPED_TRACE(::testing::Message() << (floor ? "floor" : "sphere") << ", " << far
                                          << " radii away, overlap " << overlap << " radii");
        const Scene scene = PressedSpheres({floor, far, overlap});
        const Material& m = scene.materials[0];
        Simulation simulation(scene);
        const double before = HertzForce(simulation.Particles(), m);
        simulation.Advance(1);
        const auto after = simulation.Particles();
        const double impulse = after[0].velocity.z * SphereMass(m, after[0].radius);
        const double expected = (before + HertzForce(after, m)) * simulation.time_step() / 2;
        EXPECT_NEAR(impulse / expected, 1, 1e-6);
      }
    }
  }
}

}  // namespace precision_test
}  // namespace talus::engine
