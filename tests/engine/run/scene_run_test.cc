#include "engine/run/scene_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/files/file.h"
#include "engine/run/series.h"
#include "engine/scene/scene_json.h"
#include "engine/scene/scene_warnings.h"

namespace talus::engine {
namespace scene_run_test {

namespace fs = std::filesystem;

// One sphere lies on a disc, one rolls over its edge and falls out of the domain.
constexpr const char* kEdge = R"({
  "materials": [{"name": "a", "youngs_modulus": "1 MPa"}],
  "spheres": [{"diameter": "1 mm", "position": [0, 0, "0.5 mm"]},
              {"diameter": "1 mm", "position": ["4.8 mm", 0, "0.5 mm"],
               "velocity": ["10 cm/s", 0, 0]}],
  "walls": [{"shape": "disc", "diameter": "1 cm"}],
  "domain": {"low": ["-8 mm", "-8 mm", "-4 mm"], "high": ["8 mm", "8 mm", "34 mm"]},
  "stop": {"time": 0.05}})";

TEST(SceneRun, ASphereThatLeavesTheDomainLeavesTheScene) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_domain";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << kEdge;
  const LoadedScene loaded = LoadScene(folder / "scene.json");
  SceneRun run(loaded.spec, loaded.scene, folder);
  EXPECT_EQ(run.Progress().num_particles, 2);
  while (run.Advance()) {
  }
  run.WriteResults({});
  const auto result = nlohmann::json::parse(base::ReadFile(folder / "result.json"));
  EXPECT_EQ(result["num_particles"], 1);
  EXPECT_EQ(result["num_left_domain"], 1);
  EXPECT_EQ(result["reason"], "time");
}

TEST(Series, WallsOfOneNameHaveColumnsOfTheirOwn) {
  SceneSpec spec;
  for (const char* name : {"side", "", "side", "wall1"}) spec.walls.emplace_back().name = name;
  const std::string head = Series(spec).Head();
  for (const char* column : {",side_fx_N", ",wall1_fx_N", ",side_2_fx_N", ",wall1_2_fx_N"}) {
    EXPECT_THAT(head, ::testing::HasSubstr(column));
  }
}

// Two spheres fall through a section and out of the domain, the second later: the mass below it is
// that of both, what left the domain there included, and its rate adds up to it.
TEST(Series, ASectionCountsWhatHasLeftTheDomain) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_section";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << R"({
    "materials": [{"name": "a", "youngs_modulus": "1 MPa"}],
    "spheres": [{"diameter": "1 mm", "position": [0, 0, "1 cm"]},
                {"diameter": "1 mm", "position": ["1 cm", 0, "3 cm"]}],
    "domain": {"low": [-1, -1, "-1 cm"], "high": [1, 1, 1]},
    "stop": {"time": 0.15},
    "outputs": {"interval": "10 ms", "sections": [{"name": "gate", "position": [0, 0, 0]}]}})";
  const LoadedScene loaded = LoadScene(folder / "scene.json");
  SceneRun run(loaded.spec, loaded.scene, folder);
  while (run.Advance()) {
  }
  run.WriteResults({});
  std::istringstream rows(base::ReadFile(folder / "series.csv"));
  std::string row;
  std::getline(rows, row);
  ASSERT_EQ(row, "time_s,num_spheres,gate_kg,gate_kg_s");
  double time = 0, num_spheres = 0, mass = 0, rate = 0, passed = 0, before = 0;
  char comma = 0;
  while (std::getline(rows, row)) {
    std::istringstream(row) >> time >> comma >> num_spheres >> comma >> mass >> comma >> rate;
    passed += rate * (time - before);
    before = time;
  }
  const double both = 2 * SphereMass(loaded.scene.materials[0], 0.5e-3);
  EXPECT_EQ(num_spheres, 0);
  EXPECT_NEAR(mass / both, 1, 1e-12);
  EXPECT_NEAR(passed / both, 1, 1e-9);
}

// A quotient that rounds down made a row come twice, with a rate of 0 / 0.
TEST(Series, AnIntervalBelowTheStepGivesOneRowAStep) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_rows";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << R"({
    "materials": [{"name": "a", "youngs_modulus": "1 MPa"}],
    "spheres": [{"diameter": "1 mm", "position": [0, 0, 0]}],
    "time_step": 1e-5, "stop": {"steps": 40},
    "outputs": {"interval": 2.5e-6, "sections": [{"name": "s", "position": [0, 0, 0]}]}})";
  const LoadedScene loaded = LoadScene(folder / "scene.json");
  SceneRun run(loaded.spec, loaded.scene, folder);
  while (run.Advance()) {
  }
  run.WriteResults({});
  const std::string rows = base::ReadFile(folder / "series.csv");
  EXPECT_EQ(std::ranges::count(rows, '\n'), 1 + 41);  // the head, and the start
  EXPECT_THAT(rows, ::testing::Not(::testing::HasSubstr("nan")));
}

TEST(SceneRun, WarnsOfATimeStepAboveAFifthOfTheRayleighTime) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_step";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << kEdge;
  LoadedScene loaded = LoadScene(folder / "scene.json");
  EXPECT_TRUE(SceneRun(loaded.spec, loaded.scene, folder).TakeMessages().empty());
  loaded.scene.rayleigh_fraction = 0.21;
  EXPECT_EQ(SceneRun(loaded.spec, loaded.scene, folder).TakeMessages().size(), 1u);
}

// Spheres that are yet to come count: nothing was said where only they are fine, or any.
TEST(SceneRun, WarnsOfATimeStepAboveAFifthOfThatOfAPouredSphere) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_poured_step";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << R"({
    "materials": [{"name": "a", "youngs_modulus": "1 MPa"}],
    "pours": [{"mass": "0.1 g", "sizes": {"kind": "mono", "diameter": "1 mm"},
               "mouth": [0, 0, "2 cm"], "mouth_diameter": "1 cm"}],
    "walls": [{"shape": "plane"}],
    "rayleigh_fraction": 0.3, "stop": {"time": 0.1}})";
  const LoadedScene loaded = LoadScene(folder / "scene.json");
  EXPECT_THAT(SceneRun(loaded.spec, loaded.scene, folder).TakeMessages(),
              ::testing::ElementsAre(::testing::HasSubstr("the time step is 0.3 of the Rayleigh")));
}

// Both passed without a word: a surface energy without a model, and a model without one.
TEST(SceneRun, WarnsOfAdhesionThatDoesNothing) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_adhesion";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << kEdge;
  LoadedScene loaded = LoadScene(folder / "scene.json");
  const auto messages = [&](double surface_energy, Adhesion adhesion) {
    loaded.scene.materials[0].surface_energy = surface_energy;
    loaded.scene.models.adhesion = adhesion;
    return SceneRun(loaded.spec, loaded.scene, folder).TakeMessages();
  };
  using ::testing::ElementsAre;
  using ::testing::HasSubstr;
  EXPECT_THAT(messages(1e-5, Adhesion::kNone),
              ElementsAre(HasSubstr("surface_energy is given, but models.adhesion is none")));
  EXPECT_THAT(messages(0, Adhesion::kJkr),
              ElementsAre(HasSubstr("models.adhesion is jkr, but no surface_energy is above 0")));
  EXPECT_THAT(messages(1e-5, Adhesion::kJkr), ::testing::IsEmpty());
}

// The plate's surface energy alone was taken for adhesion, which the geometric mean of (P6) is not.
TEST(SceneRun, WarnsOfAPlateThatHasTheOnlySurfaceEnergy) {
  const fs::path file = fs::path(::testing::TempDir()) / "sticky_plate.json";
  std::ofstream(file) << R"({
    "materials": [{"name": "powder"}, {"name": "plate", "surface_energy": 1e-4}],
    "models": {"adhesion": "jkr"},
    "spheres": [{"diameter": "1 mm", "position": [0, 0, 0.01], "material": "powder"}],
    "walls": [{"shape": "plane", "material": "plate"}], "stop": {"time": 0.1}})";
  LoadedScene loaded = LoadScene(file);
  EXPECT_THAT(SceneWarnings(loaded.spec, loaded.scene),
              ::testing::ElementsAre(::testing::HasSubstr(
                  "models.adhesion is jkr, but of no two materials that touch both have a "
                  "surface_energy above 0: nothing adheres")));
  loaded.scene.pairs = {{.first = 0, .second = 1, .stated = {.surface_energy = 1e-4}}};
  EXPECT_THAT(SceneWarnings(loaded.spec, loaded.scene), ::testing::IsEmpty());
}

// A gate that was to open after the end, and a slip of s for ms, went unseen.
TEST(SceneRun, WarnsOfWhatIsToHappenAfterTheEnd) {
  const fs::path file = fs::path(::testing::TempDir()) / "late.json";
  std::ofstream(file) << R"({
    "materials": [{"name": "a", "youngs_modulus": "1 MPa"}],
    "spheres": [{"diameter": "1 mm", "position": [0, 0, 0.01]}],
    "walls": [{"shape": "disc", "diameter": "1 cm", "removed_at": 5,
               "taps": {"height": "1 mm", "interval": "50 ms", "count": 3, "start": 6}},
              {"shape": "plane", "motion": [{"time": 0.1, "velocity": [0, 0, 0]},
                                            {"time": 4, "velocity": [0, 0, 0]}]}],
    "gravity_turns": [{"time": 3, "angular_velocity": [1, 0, 0]}],
    "outputs": {"interval": 2}, "stop": {"time": 0.3}})";
  const LoadedScene loaded = LoadScene(file);
  EXPECT_THAT(
      SceneWarnings(loaded.spec, loaded.scene),
      ::testing::ElementsAre(
          ::testing::HasSubstr("walls[0].removed_at: is 5 s, after the end at 0.3 s"),
          ::testing::HasSubstr("walls[0].taps.start: is 6 s"),
          ::testing::HasSubstr("walls[1].motion[1].time"),
          ::testing::HasSubstr("gravity_turns[0].time"), ::testing::HasSubstr("outputs.interval")));
}

// 1 g at 1 g/s, ended after 20 ms: the counts stood in result.json only.
TEST(SceneRun, SaysAtItsEndWhatWillNotComeAnyMore) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_cut";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << R"({
    "materials": [{"name": "a", "youngs_modulus": "1 MPa"}],
    "pours": [{"material": "a", "mass": "1 g", "rate": "1 g/s", "mouth_diameter": "8 mm",
               "sizes": {"kind": "mono", "diameter": "1 mm"}, "mouth": [0, 0, 0.02]}],
    "walls": [{"shape": "plane"}], "stop": {"time": 0.02}})";
  const LoadedScene loaded = LoadScene(folder / "scene.json");
  SceneRun run(loaded.spec, loaded.scene, folder);
  std::vector<std::string> messages;
  while (run.Advance()) {
  }
  messages = run.TakeMessages();
  EXPECT_THAT(messages, ::testing::Contains(::testing::ContainsRegex(
                            "warning: pours.0.: [0-9]+ of [0-9]+ spheres had not been poured")));
}

TEST(SceneRun, WarnsOfOutputsAfterTheLastStep) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_outputs";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << kEdge;
  LoadedScene loaded = LoadScene(folder / "scene.json");
  loaded.spec.stop.steps = 10;
  loaded.spec.outputs.times = {0.04};
  EXPECT_THAT(SceneRun(loaded.spec, loaded.scene, folder).TakeMessages(),
              ::testing::ElementsAre(::testing::HasSubstr("is not written")));
}

class ExampleScene : public ::testing::TestWithParam<const char*> {};

// A wall that cuts through the fill would end the run within these steps.
TEST_P(ExampleScene, Runs) {
  LoadedScene loaded =
      LoadScene(std::string(TALUS_SOURCE_DIR "/examples/scenes/") + GetParam() + ".json");
  loaded.spec.stop.steps = 300;
  loaded.spec.outputs.times.clear();
  const fs::path folder = fs::path(::testing::TempDir()) / (std::string("example_") + GetParam());
  fs::create_directories(folder);
  SceneRun run(loaded.spec, loaded.scene, folder);
  while (run.Advance()) {
  }
  run.WriteResults({});
  const auto result = nlohmann::json::parse(base::ReadFile(folder / "result.json"));
  EXPECT_EQ(result["reason"], "steps");
  EXPECT_EQ(result["num_particles"], loaded.scene.particles.size());
  EXPECT_EQ(fs::exists(folder / "series.csv"), loaded.spec.outputs.interval.has_value());
}
INSTANTIATE_TEST_SUITE_P(All, ExampleScene,
                         ::testing::Values("drum", "hopper", "draw_down", "column_collapse",
                                           "tilting_box"));

// What lies still behind its gate is not at its end.
TEST(SceneRun, ASceneIsNotAtRestBeforeItsGateHasOpened) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_gate";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << R"({
    "materials": [{"name": "a", "youngs_modulus": "1 MPa", "restitution": 0.3}],
    "spheres": [{"diameter": "1 mm", "position": [0, 0, "2.5 mm"]}],
    "walls": [{"shape": "plane"},
              {"shape": "disc", "diameter": "1 cm", "position": [0, 0, "2 mm"],
               "removed_at": "0.1 s"}],
    "stop": {"time": 0.5, "energy_fraction": 1e-4}})";
  const LoadedScene loaded = LoadScene(folder / "scene.json");
  SceneRun run(loaded.spec, loaded.scene, folder);
  while (run.Advance()) {
  }
  EXPECT_GT(run.Progress().time, 0.12);  // 0.1 s, and 2 mm of fall
  EXPECT_LT(run.Progress().time, 0.3);
}

// Its time when it ends, of a scene that lies still but for what `more` adds.
double EndOfQuiet(const std::string& name, const std::string& more) {
  const fs::path folder = fs::path(::testing::TempDir()) / ("scene_run_" + name);
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << R"({
    "materials": [{"name": "a", "youngs_modulus": "1 MPa", "restitution": 0.3}],
    "spheres": [{"diameter": "1 mm", "position": [0, 0, "0.5 mm"]}],
    "stop": {"time": 0.5, "energy_fraction": 1e-4},
    "walls": [{"shape": "plane"}, {"shape": "disc", "diameter": "1 cm", "position": [0, 0, "2 cm"])"
                                       << more << "}";
  const LoadedScene loaded = LoadScene(folder / "scene.json");
  SceneRun run(loaded.spec, loaded.scene, folder);
  while (run.Advance()) {
  }
  return run.Progress().time;
}

// Whatever moves slowly enough leaves the grains quiet all the while: its end was taken for its
// last change.
TEST(SceneRun, ASceneIsNotAtRestWhileAWallMovesOrGravityTurns) {
  EXPECT_LT(EndOfQuiet("still", "}]"), 0.2);
  EXPECT_GE(EndOfQuiet("lift", R"(, "motion": [{"time": 0, "velocity": [0, 0, "1 mm/s"]}]}])"),
            0.5);
  EXPECT_GT(EndOfQuiet("stopped", R"(, "motion": [{"time": 0, "velocity": [0, 0, "1 mm/s"]},
                                                  {"time": 0.3}]}])"),
            0.3);
  EXPECT_GE(
      EndOfQuiet(
          "turn",
          R"(}], "gravity_turns": [{"time": 0.01, "angular_velocity": [0, "0.1 deg/s", 0]}])"),
      0.5);
}

// A sphere spins in a groove without moving: friction needs 2 μ g/√2 / (0.4 R) = 694 rad/s² of
// braking to end that, 0.29 s for 200 rad/s. So it does where a pair of materials alone states that
// friction.
TEST(SceneRun, ASceneThatSpinsIsNotAtRest) {
  const fs::path folder = fs::path(::testing::TempDir()) / "scene_run_spin";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << R"({
    "materials": [{"name": "a", "youngs_modulus": "1 MPa", "restitution": 0.3,
                   "sliding_friction": 0.01}],
    "spheres": [{"diameter": "1 mm", "position": [0, 0, "0.7071 mm"],
                 "angular_velocity": [0, 200, 0]}],
    "walls": [{"shape": "plane", "direction": [1, 0, 1]},
              {"shape": "plane", "direction": [-1, 0, 1]}],
    "models": {"rolling": "none"},
    "stop": {"time": 1, "energy_fraction": 1e-4}})";
  const LoadedScene loaded = LoadScene(folder / "scene.json");
  LoadedScene paired = loaded;
  paired.spec.materials[0].material.sliding_friction = 0;
  paired.scene.materials[0].sliding_friction = 0;
  paired.scene.pairs = {{.first = 0, .second = 0, .stated = {.sliding_friction = 0.01}}};
  for (const LoadedScene& each : {loaded, paired}) {
    SceneRun run(each.spec, each.scene, folder);
    while (run.Advance()) {
    }
    EXPECT_GT(run.Progress().time, 0.27);
    EXPECT_LT(run.Progress().time, 0.4);
  }
}

}  // namespace scene_run_test
}  // namespace talus::engine
