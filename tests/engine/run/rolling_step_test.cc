#include "engine/laws/rolling_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/files/file.h"
#include "engine/bodies/particle.h"
#include "engine/laws/pressed_bed.h"
#include "engine/run/scene_run.h"
#include "engine/scene/scene_json.h"
#include "engine/scene/scene_warnings.h"

namespace talus::engine {
namespace rolling_step_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Grains that resist rolling strongly, in a glass.
LoadedScene Bed(const std::string& name, double rayleigh_fraction, double rolling_damping) {
  const fs::path file = fs::path(::testing::TempDir()) / (name + ".json");
  std::ofstream(file) << R"({
    "materials": [{"name": "a", "youngs_modulus": 1e6, "restitution": 0.5, "rolling_friction": 1,
                   "sliding_friction": 0.5, "rolling_damping": )"
                      << rolling_damping << R"(}],
    "fills": [{"mass": "0.15 g", "sizes": {"kind": "uniform", "min": "0.7 mm", "max": "1 mm"},
               "region": {"shape": "cylinder", "diameter": "6 mm"}}],
    "walls": [{"shape": "plane"}, {"shape": "open_cylinder", "diameter": "6 mm", "length": 0.02}],
    "rayleigh_fraction": )"
                      << rayleigh_fraction
                      << R"(, "stop": {"time": 0.5, "energy_fraction": 1e-4}})";
  return LoadScene(file);
}

std::string WhyEnded(const LoadedScene& loaded, const std::string& name) {
  const fs::path folder = fs::path(::testing::TempDir()) / name;
  fs::create_directories(folder);
  SceneRun run(loaded.spec, loaded.scene, folder);
  while (run.Advance()) {
  }
  run.WriteResults({});
  return nlohmann::json::parse(base::ReadFile(folder / "result.json"))["reason"];
}

// (R3) and the two inertias, written out for one overlap.
TEST(RollingStep, TheDampedShareIsThatOfOneContact) {
  const Material m{
      .density = 2500, .youngs_modulus = 1e6, .rolling_friction = 0.4, .rolling_damping = 0.7};
  const PairConstants pair = MakePairConstants(m, m, {});
  const double r = 5e-4, mass = SphereMass(m, r), dt = 1e-5, stress = 100;
  const double delta = PressedOverlap(pair, stress) * r;
  const double k_n = 4.0 / 3 * pair.y_star * std::sqrt(r / 2 * delta);
  const double k_r = 2.25 * k_n * std::pow(0.4 * r / 2, 2);
  const double c_r = 2 * 0.7 * std::sqrt(0.7 * mass * r * r * k_r);
  const double share = c_r * dt * 2 / (0.4 * mass * r * r);
  const BedGrains grains{.radius = r, .density = m.density, .stress = stress};
  EXPECT_NEAR(DampedShare(pair, grains, dt), share, 1e-12 * share);
  const RollingLimit longest = LongestRollingStep(pair, grains);
  EXPECT_NEAR(DampedShare(pair, grains, longest.step), kMostDampedShare, 1e-12);
  EXPECT_FALSE(longest.is_spring);
  const Material smooth{.rolling_friction = 0};
  EXPECT_TRUE(std::isinf(LongestRollingStep(MakePairConstants(smooth, smooth, {}), grains).step));
}

// (R1) and the grains' inertia, as above. With little damping it is the spring that bounds the
// step.
TEST(RollingStep, TheSpringsPhaseIsThatOfOneContact) {
  const Material m{
      .density = 2500, .youngs_modulus = 1e6, .rolling_friction = 3, .rolling_damping = 0.05};
  const PairConstants pair = MakePairConstants(m, m, {});
  const double r = 5e-4, mass = SphereMass(m, r), dt = 1e-5, stress = 100;
  const double k_n = 4.0 / 3 * pair.y_star * std::sqrt(r / 2 * PressedOverlap(pair, stress) * r);
  const double k_r = 2.25 * k_n * std::pow(3 * r / 2, 2);
  const double phase = std::sqrt(k_r * 2 / (0.4 * mass * r * r)) * dt;
  const BedGrains grains{.radius = r, .density = m.density, .stress = stress};
  EXPECT_NEAR(SpringPhase(pair, grains, dt), phase, 1e-12 * phase);
  const RollingLimit longest = LongestRollingStep(pair, grains);
  EXPECT_NEAR(SpringPhase(pair, grains, longest.step), kMostSpringPhase, 1e-12);
  EXPECT_TRUE(longest.is_spring);
}

// At 0.30 t_R its dashpot takes 0.9 of a spin a contact: the grains chatter, and it is said. At a
// third of that the same bed lies still, as one with less damping does at 0.30.
TEST(RollingStep, ABedComesToRestWhereTheStepIsNotWarnedOf) {
  const LoadedScene too_long = Bed("too_long", 0.30, 1);
  EXPECT_THAT(SceneWarnings(too_long.spec, too_long.scene),
              ::testing::Contains(HasSubstr("materials[0].rolling_damping")));
  EXPECT_EQ(WhyEnded(too_long, "too_long"), "time");
  for (const auto& [fraction, damping] : {std::pair{0.10, 1.0}, std::pair{0.20, 0.3}}) {
    const LoadedScene loaded = Bed("short", fraction, damping);
    EXPECT_THAT(SceneWarnings(loaded.spec, loaded.scene), IsEmpty());
    EXPECT_EQ(WhyEnded(loaded, "short"), "at_rest") << fraction;
  }
}

}  // namespace rolling_step_test
}  // namespace talus::engine
