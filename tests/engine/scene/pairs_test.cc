// What a pair of materials states takes the place of what follows from the two (P8).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/scene/scene_json.h"
#include "tests/engine/scenes.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace pairs_test {

using ::testing::HasSubstr;

constexpr double kRadius = 1e-3;
constexpr double kGravity = 9.81;
constexpr double kSlope = std::numbers::pi / 3;

// Powder of 0.45 on a plate of 0.25, at the overlap that carries its weight on the slope.
Scene SphereOnSlope(const std::string& pairs) {
  const std::string text = R"({
    "materials": [{"name": "powder", "sliding_friction": 0.45, "rolling_friction": 0},
                  {"name": "plate", "sliding_friction": 0.25}],
    "pairs": [)" + pairs + R"(],
    "spheres": [{"diameter": "2 mm", "position": [0, 0, "1 mm"]}],
    "walls": [{"shape": "plane", "material": "plate"}],
    "stop": {"time": 1}})";
  Scene scene = LoadScene(base::ParseJson(text, "scene.json")).scene;
  const double normal = kGravity * std::cos(kSlope);
  scene.gravity = {kGravity * std::sin(kSlope), 0, -normal};
  const Material& powder = scene.materials[0];
  const double stiffness =
      4.0 / 3 * MakePairConstants(powder, scene.materials[1], {}).y_star * std::sqrt(kRadius);
  scene.particles[0].position.z -=
      std::pow(SphereMass(powder, kRadius) * normal / stiffness, 2.0 / 3);
  return scene;
}

struct SlidingCase {
  const char* pairs;
  double friction;  // that of the pair of powder and plate [-]
};
class SphereSlides : public ::testing::TestWithParam<SlidingCase> {};

// At 60° a sphere slides for μ < tan 60°/3.5 = 0.49:
//   v = g (sin α − μ cos α) t      R ω = (5/2) μ g cos α t
// The spring winds up in less than a thousandth of the time.
TEST_P(SphereSlides, DownASlopeAtTheFrictionOfThePair) {
  Simulation simulation(SphereOnSlope(GetParam().pairs));
  simulation.Advance(std::llround(0.1 / simulation.time_step()));
  const Particle p = simulation.Particles()[0];
  const double time = simulation.time(), mu = GetParam().friction;
  const double speed = kGravity * (std::sin(kSlope) - mu * std::cos(kSlope)) * time;
  const double spin = 2.5 * mu * kGravity * std::cos(kSlope) * time;
  EXPECT_NEAR(p.velocity.x / speed, 1, 1e-3);
  EXPECT_NEAR(kRadius * p.angular_velocity.y / spin, 1, 1e-3);
}
INSTANTIATE_TEST_SUITE_P(
    Stated, SphereSlides,
    ::testing::Values(
        SlidingCase{R"({"between": ["powder", "plate"], "sliding_friction": 0.25})", 0.25},
        SlidingCase{R"({"between": ["plate", "powder"], "sliding_friction": 0.1})", 0.1},
        // What concerns others leaves the harmonic mean of 0.45 and 0.25.
        SlidingCase{R"({"between": ["powder", "powder"], "sliding_friction": 0.1})",
                    2 * 0.45 * 0.25 / 0.7},
        SlidingCase{R"({"between": ["powder", "plate"], "restitution": 0.5})",
                    2 * 0.45 * 0.25 / 0.7}));

TEST(Pairs, EachPairReboundsByItsOwnRestitution) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.materials.push_back(testing::Glass());
  scene.pairs = {{.first = 1, .second = 0, .stated = {.restitution = 0.4}}};
  const double speed = 0.1, gap = 1e-9;
  scene.walls = {testing::Floor()};
  scene.walls[0].material = 1;
  scene.particles = {
      {.id = 0, .radius = kRadius, .position = {0, 0, kRadius + gap}, .velocity = {0, 0, -speed}},
      {.id = 1, .radius = kRadius, .position = {0, 0, 1}, .velocity = {0, 0, speed}},
      {.id = 2, .radius = kRadius, .position = {0, 0, 1 + 2 * kRadius + gap}}};
  const double mass = SphereMass(scene.materials[0], kRadius);
  const testing::HertzImpact impact{
      .y_star = MakePairConstants(scene.materials[0], scene.materials[1], {}).y_star,
      .r_star = kRadius / 2,
      .m_star = mass / 2,
      .speed = speed};
  scene.time_step = impact.Duration() / 2000;
  Simulation simulation(scene);
  simulation.Advance(6000);
  ASSERT_TRUE(simulation.Contacts().empty());
  const auto after = simulation.Particles();
  EXPECT_NEAR(after[0].velocity.z / speed, 0.4, 1e-3);
  EXPECT_NEAR((after[2].velocity.z - after[1].velocity.z) / speed, 0.9, 1e-3);
}

// γ* = 2γ, though one of the two materials does not adhere to anything else.
TEST(Pairs, AdhesionOfAPairIsThatOfTwoSurfacesOfItsEnergy) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.models.adhesion = Adhesion::kDmt;
  scene.materials.push_back(testing::Glass());
  scene.materials[0].surface_energy = 0.1;
  scene.pairs = {{.first = 0, .second = 1, .stated = {.restitution = 1, .surface_energy = 2e-3}}};
  scene.walls = {testing::Floor()};
  scene.walls[0].material = 1;
  const double overlap = 1e-12;
  scene.particles = {{.radius = kRadius, .position = {0, 0, kRadius - overlap}}};
  const auto contacts = Simulation(scene).Contacts();
  ASSERT_EQ(contacts.size(), 1u);
  const double pull = 2 * std::numbers::pi * 4e-3 * kRadius;  // A1; Hertz takes 1e-8 of it
  EXPECT_NEAR(contacts[0].force.z / -pull, 1, 1e-6);
}

TEST(Pairs, ARestoredRunKeepsThem) {
  Simulation straight(
      SphereOnSlope(R"({"between": ["powder", "plate"], "sliding_friction": 0.1})"));
  straight.Advance(100);
  Simulation restored = Simulation::Restore(straight.Checkpoint());
  straight.Advance(1000);
  restored.Advance(1000);
  EXPECT_EQ(restored.Particles()[0].velocity, straight.Particles()[0].velocity);
  EXPECT_TRUE(restored.Checkpoint() == straight.Checkpoint());
}

std::string ErrorOf(const std::vector<MaterialPair>& pairs) {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.pairs = pairs;
  return ErrorIn([&] { const Simulation simulation(scene); });
}

TEST(Pairs, TheSolverRefusesWhatNoFileCanGive) {
  const MaterialPair own{.first = 0, .second = 0, .stated = {.restitution = 0.5}};
  EXPECT_EQ(ErrorOf({own}), "");
  EXPECT_THAT(ErrorOf({own, own}), HasSubstr("pairs[1]: is given twice"));
  EXPECT_THAT(ErrorOf({{.first = 0, .second = 1}}), HasSubstr("pairs[0]: is not of the scene's"));
  EXPECT_THAT(ErrorOf({{.first = 0, .second = 0, .stated = {.sliding_friction = -1.0}}}),
              HasSubstr("pairs[0].sliding_friction: is -1, must not be negative"));
}

}  // namespace pairs_test
}  // namespace talus::engine
