// Grains that come out of a funnel's mouth, and what a scene counts of them.
#include "engine/scene/pour.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/files/file.h"
#include "engine/run/bed.h"
#include "engine/run/scene_run.h"
#include "engine/scene/scene_json.h"
#include "tests/engine/scenes.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace pour_test {

namespace fs = std::filesystem;

constexpr const char* kCup = R"({
  "materials": [{"name": "a", "youngs_modulus": "5 MPa", "density": 2500, "restitution": 0.5,
                 "sliding_friction": 0.5}],
  "pours": [{"mass": "0.6 g", "sizes": {"kind": "uniform", "min": "0.8 mm", "max": "1.2 mm"},
             "mouth": [0, 0, "30 mm"], "mouth_diameter": "6 mm", "scatter": "1 cm/s"}],
  "walls": [{"name": "floor", "shape": "disc", "diameter": "11 mm"},
            {"shape": "open_cylinder", "diameter": "11 mm", "length": "25 mm"}],
  "stop": {"energy_fraction": 1e-4, "time": 1},
  "outputs": {"interval": "10 ms", "sections": [{"name": "rim", "position": [0, 0, "25 mm"]}]}})";

LoadedScene Load(const std::string& text, const std::string& name) {
  const fs::path folder = fs::path(::testing::TempDir()) / name;
  fs::create_directories(folder);
  std::ofstream(folder / "scene.json") << text;
  return LoadScene(folder / "scene.json");
}

PourPlan Plan() {
  return {.radii = std::vector<double>(500, 0.5e-3),
          .material = 0,
          .density = 2500,
          .mouth = {0, 0, 0.1},
          .mouth_diameter = 10e-3,
          .rate = 0.01,
          .gravity = {0, 0, -9.81},
          .seed = 3};
}

// W = 0.58 · 0.58 · 2500 · √9.81 · (0.01 − 0.0014)^2.5
TEST(Pour, RunsAsFastAsBeverlooSays) {
  EXPECT_NEAR(BeverlooRate(Plan()), 0.58 * 0.58 * 2500 * 3.13209 * 6.8590e-6, 1e-6);
  // Grains of 1 mm that stand for grains of 0.25 mm: the funnel is emptied of those.
  PourPlan fine = Plan();
  for (double& r : fine.radii) r /= 4;
  EXPECT_DOUBLE_EQ(BeverlooRate(Plan(), 4), BeverlooRate(fine));
}

Simulation NothingYet() {
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.gravity = {0, 0, -9.81};
  scene.time_step = 1e-6;
  return Simulation(scene);
}

TEST(Pour, AnotherSeedGivesOtherPlaces) {
  const auto first = [](std::uint64_t seed) {
    PourPlan plan = Plan();
    plan.seed = seed;
    Simulation simulation = NothingYet();
    PourState state;
    Pour(plan).Advance(simulation, state);
    return simulation.Particles().at(0).position;
  };
  EXPECT_EQ(first(3), first(3));
  EXPECT_NE(first(3), first(4));
}

TEST(Pour, AMouthThatRisesDoesSoWithTheMassThatHasCome) {
  PourPlan plan = Plan();
  plan.rise = 1000;  // [m/kg]
  Simulation simulation = NothingYet();
  PourState state;
  const Pour pour(plan);
  pour.Advance(simulation, state);
  const std::int64_t before = state.num_poured;
  simulation.Advance(std::llround(std::ceil((pour.NextTime(state) - simulation.time()) / 1e-6)));
  pour.Advance(simulation, state);
  ASSERT_GT(state.num_poured, before);
  const double mass = static_cast<double>(before) * SphereMass({.density = 2500}, 0.5e-3);
  for (const Particle& p : simulation.Particles()) {
    if (p.id < before) continue;
    EXPECT_GE(p.position.z, 0.1 + plan.rise * mass - 1e-12);
  }
}

// After the first batch, mass comes at the rate, and nothing that comes touches anything.
TEST(Pour, GrainsComeAtTheRateAndTouchNothing) {
  const Pour pour(Plan());
  PourState state;
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.gravity = {0, 0, -9.81};
  scene.time_step = 1e-6;
  Simulation simulation(scene);
  double mass_early = 0, time_early = 0;
  while (!pour.Done(state)) {
    pour.Advance(simulation, state);
    EXPECT_TRUE(simulation.Contacts().empty());
    const double mass = state.num_poured * 4.0 / 3 * std::numbers::pi * 1.25e-10 * 2500;
    if (time_early == 0 && simulation.time() > 0.01) {
      mass_early = mass;
      time_early = simulation.time();
    } else if (time_early > 0 && simulation.time() > time_early + 0.03) {
      // A batch is 2 mg of 300.
      EXPECT_NEAR((mass - mass_early) / (simulation.time() - time_early) / 0.01, 1, 0.05);
      break;
    }
    const double to_go = pour.NextTime(state) - simulation.time();
    simulation.Advance(std::max<std::int64_t>(1, std::llround(std::ceil(to_go / 1e-6))));
  }
  EXPECT_GT(state.num_poured, 100);
}

// Centres have a quarter of this mouth. At the speed that is enough for wide ones a tenth waited.
TEST(Pour, GrainsComeAtTheRateThroughANarrowMouth) {
  for (const std::uint64_t seed : {3, 4}) {
    PourPlan plan = Plan();
    plan.mouth_diameter = 2.05e-3;
    plan.rate = 0.004;
    plan.seed = seed;
    const Pour pour(plan);
    PourState state;
    Scene scene = testing::EmptySpace(testing::Glass());
    scene.gravity = {0, 0, -9.81};
    scene.time_step = 1e-6;
    Simulation simulation(scene);
    while (simulation.time() < 0.1) {
      pour.Advance(simulation, state);
      const double to_go = pour.NextTime(state) - simulation.time();
      simulation.Advance(std::max<std::int64_t>(1, std::llround(std::ceil(to_go / 1e-6))));
    }
    const double grain = 4.0 / 3 * std::numbers::pi * 1.25e-10 * 2500;
    // A batch is a hundredth of what has come.
    EXPECT_NEAR(static_cast<double>(state.num_poured) * grain / (0.004 * simulation.time()), 1,
                0.03)
        << seed;
  }
}

// Where nothing can leave the mouth, grains wait; none is pressed into another.
TEST(Pour, GrainsWaitWhereThereIsNoRoom) {
  PourPlan plan = Plan();
  plan.mouth = {0, 0, 0};
  const Pour pour(plan);
  PourState state;
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.gravity = {0, 0, -9.81};
  scene.particles = {{.id = 10000, .radius = 20e-3, .position = {0, 0, 2e-3}}};
  Simulation simulation(scene);
  pour.Advance(simulation, state);
  EXPECT_EQ(simulation.num_particles(), 1);
  EXPECT_EQ(state.num_poured, 0);
  EXPECT_GT(pour.NextTime(state), 0);
}

// Two grains lie below the mouth on others, one of them beside it, one falls, and one is at the top
// of its hop: the one that lies is kept 5 mm away; what is poured makes no difference, and the
// mouth never sinks.
TEST(Pour, AMouthThatFollowsKeepsItsDistanceFromWhatLiesBelowIt) {
  PourPlan plan = Plan();
  plan.mouth = {0, 0, 6e-3};
  plan.clearance = 5e-3;
  const Pour pour(plan);
  PourState state;
  Scene scene = testing::EmptySpace(testing::Glass());
  scene.gravity = {0, 0, -9.81};
  scene.particles = {
      {.id = 10000, .radius = 1e-3, .position = {1e-3, 0, 2e-3}},
      {.id = 10001, .radius = 1e-3, .position = {9e-3, 0, 3e-3}},
      {.id = 10002, .radius = 1e-3, .position = {0, 0, 4e-3}, .velocity = {0, 0, -1}},
      {.id = 10003, .radius = 1e-3, .position = {1e-3, 0, 1e-6}},
      {.id = 10004, .radius = 1e-3, .position = {9e-3, 0, 1e-3 + 1e-6}},
      {.id = 10005, .radius = 1e-3, .position = {-1.5e-3, 1.5e-3, 5.5e-3}}};
  Simulation simulation(scene);
  pour.Advance(simulation, state);
  EXPECT_NEAR(state.lift, 3e-3 + 5e-3 - 6e-3, 1e-12);
  for (const Particle& p : simulation.Particles()) {
    EXPECT_TRUE(p.id >= 10000 || p.position.z >= 8e-3);
  }
  const double lift = state.lift;
  simulation.Advance(std::llround(std::ceil(0.05 / simulation.time_step())));  // all have fallen
  pour.Advance(simulation, state);
  EXPECT_GE(state.lift, lift);
}

TEST(PouredScene, FillsTheCupWithAllOfTheMass) {
  const LoadedScene loaded = Load(kCup, "poured_scene");
  const fs::path folder = fs::path(::testing::TempDir()) / "poured_scene";
  SceneRun run(loaded.spec, loaded.scene, folder);
  while (run.Advance()) {
  }
  run.WriteResults({});
  const auto result = nlohmann::json::parse(base::ReadFile(folder / "result.json"));
  EXPECT_EQ(result["reason"], "at_rest");
  EXPECT_EQ(result["pours"][0]["num_waiting"], 0);
  EXPECT_EQ(result["pours"][0]["num_poured"], result["num_particles"]);
  // The last row: all of the mass is below the rim, and the walls carry its weight.
  std::istringstream rows(base::ReadFile(folder / "series.csv"));
  std::string head, row, last;
  std::getline(rows, head);
  while (std::getline(rows, row)) last = row;
  EXPECT_EQ(head.substr(0, 32), "time_s,num_spheres,floor_fx_N,fl");
  std::vector<double> values;
  std::istringstream columns(last);
  for (std::string cell; std::getline(columns, cell, ',');) values.push_back(std::stod(cell));
  ASSERT_EQ(values.size(), 2u + 12 + 2);
  const double mass = values[14];
  EXPECT_NEAR(mass, 0.6e-3, 2.3e-6);                                // to within a grain
  EXPECT_NEAR((values[4] + values[10]) / (-mass * 9.81), 1, 0.01);  // still ringing a little
}

TEST(PouredScene, ARestartGoesOnWithTheSameBits) {
  const LoadedScene loaded = Load(kCup, "poured_restart");
  const fs::path folder = fs::path(::testing::TempDir()) / "poured_restart";
  SceneRun whole(loaded.spec, loaded.scene, folder);
  SceneRun first(loaded.spec, loaded.scene, folder);
  for (int k = 0; k < 12; ++k) first.Advance();
  EXPECT_GT(first.Progress().num_particles, 0);
  SceneRun second(loaded.spec, folder, Unpack(first.Checkpoint({})));
  while (second.Progress().time < 0.08) second.Advance();
  while (whole.Progress().time < second.Progress().time) whole.Advance();
  EXPECT_TRUE(whole.Checkpoint({}) == second.Checkpoint({}));
}

TEST(PouredScene, BadPoursAreRefused) {
  const auto error_of = [](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return ErrorIn([&] { Load(text, "bad_pour"); });
  };
  EXPECT_NE(error_of(kCup, "\"6 mm\"", "\"2 mm\"").find("pours[0].mouth_diameter"),
            std::string::npos);
  EXPECT_NE(error_of(kCup, "\"0.6 g\"", "0").find("pours[0].mass"), std::string::npos);
  EXPECT_NE(error_of(kCup, "\"stop\"", "\"time_step\": 1e-4, \"stop\"").find("poured sphere"),
            std::string::npos);
  // Grains appear up to four largest radii above the mouth, 32.4 mm, and across it: to ±3 mm.
  const auto with_domain = [&](const std::string& high) {
    return error_of(kCup, "\"stop\"",
                    R"("domain": {"low": [-0.01, -0.01, -0.01], "high": )" + high + R"(}, "stop")");
  };
  EXPECT_EQ(with_domain("[0.01, 0.01, 0.035]"), "");
  EXPECT_NE(with_domain("[0.01, 0.01, 0.031]").find("pours[0].mouth: puts"), std::string::npos);
  EXPECT_NE(with_domain("[0.01, 0.002, 0.035]").find("pours[0].mouth: puts"), std::string::npos);
}

TEST(PouredScene, TapsNeedGravity) {
  std::string text = kCup;
  text.replace(text.find("\"energy_fraction\": 1e-4, "), 25, "");
  const std::string from = "\"floor\", ";
  text.replace(text.find(from), from.size(),
               from + R"("taps": {"count": 2, "height": 3e-3, "interval": 0.12}, )");
  EXPECT_EQ(ErrorIn([&] { Load(text, "taps"); }), "");
  // Ten times faster falls fit into a shorter interval, which was judged by 9.81 m/s².
  std::string heavy = text;
  heavy.replace(heavy.find("0.12}"), 4, "0.03");
  heavy.replace(heavy.find("\"materials\""), 0, "\"gravity\": [0, 0, -981], ");
  EXPECT_EQ(ErrorIn([&] { Load(heavy, "taps"); }), "");
  text.replace(text.find("\"materials\""), 0, "\"gravity\": [0, 0, 0], ");
  EXPECT_NE(ErrorIn([&] { Load(text, "taps"); }).find("walls[0].taps: need gravity"),
            std::string::npos);
}

// 4 × 4 × 3 spheres of radius 1 in a square lattice: half the height of the column is its middle.
TEST(Bed, MeasuresALattice) {
  Scene scene = testing::EmptySpace(testing::Glass());
  const double r = 1e-3;
  for (int i = 0; i < 48; ++i) {
    const Vec3 at{2 * r * (i % 4), 2 * r * (i / 4 % 4), r + 1.999 * r * (i / 16)};
    scene.particles.push_back({.id = i, .radius = r, .position = at});
  }
  const Bed bed = MeasureBed(Simulation(scene), {.area = 64 * r * r, .floor = 0});
  EXPECT_NEAR(bed.height, 2 * (r + 1.999 * r), 1e-12);
  EXPECT_NEAR(bed.solid_fraction, std::numbers::pi / 6, 1e-3);
  EXPECT_NEAR(bed.coordination, 2 * 32 / 48.0, 1e-12);  // only the layers touch
  // What lies below the floor is not of the bed, nor are its contacts.
  const Bed upper = MeasureBed(Simulation(scene), {.area = 64 * r * r, .floor = 2 * r});
  EXPECT_NEAR(upper.coordination, 2 * 16 / 32.0, 1e-12);
}

}  // namespace pour_test
}  // namespace talus::engine
