// What single precision costs: the kernels' collisions against the same laws and the same steps in
// double precision, for grains from a micrometre to a centimetre.
#include <gtest/gtest.h>

#include "engine/laws/law_list.h"
#include "tests/engine/scenes.h"

namespace talus::engine {
namespace {

using Law = Response<double> (*)(const PairConstants&, const Contact<double>&, const double&,
                                 History<double>&);

template <class Normal>
Law PickRolling(Rolling rolling) {
  const Law list[] = {Respond<Normal, NoRolling>, Respond<Normal, ConstantRolling>,
                      Respond<Normal, ViscousRolling>, Respond<Normal, EpsdRolling>};
  return list[static_cast<int>(rolling)];
}

Law PickLaw(const ContactModels& models) {
  if (models.adhesion == Adhesion::kDmt) return PickRolling<DmtAdhesion>(models.rolling);
  if (models.adhesion == Adhesion::kJkr) return PickRolling<JkrAdhesion>(models.rolling);
  return PickRolling<NoAdhesion>(models.rolling);
}

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
  Law law_;
  double dt_;
  History<double> history_{};
};

struct Case {
  Adhesion adhesion;
  Rolling rolling;
  double radius;  // [m]
};

// Two unequal spheres, apart at first, far from the origin, that meet at an angle and with spin.
Scene Meeting(const Case& c) {
  Material material = testing::Glass();
  material.surface_energy = c.adhesion == Adhesion::kNone ? 0 : 3e-2 * c.radius;
  Scene scene = testing::EmptySpace(material);
  scene.models = {.adhesion = c.adhesion, .rolling = c.rolling};
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
    for (const Adhesion adhesion : {Adhesion::kNone, Adhesion::kDmt, Adhesion::kJkr}) {
      for (const Rolling rolling :
           {Rolling::kNone, Rolling::kConstant, Rolling::kViscous, Rolling::kEpsd}) {
        SCOPED_TRACE(::testing::Message() << "radius " << radius << ", " << base::NameOf(adhesion)
                                          << ", " << base::NameOf(rolling));
        const Scene scene = Meeting({adhesion, rolling, radius});
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
}

}  // namespace
}  // namespace talus::engine
