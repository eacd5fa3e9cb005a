#include "engine/scene/scene_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "base/json/json_schema.h"
#include "tests/error_in.h"

namespace talus::engine {
namespace scene_json_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::filesystem::path Write(const std::string& text) {
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) /
      (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".json");
  std::ofstream(path) << text;
  return path;
}

std::string ErrorOf(const std::string& text) {
  return ErrorIn([&] { LoadScene(Write(text)); });
}

constexpr const char* kPair = R"({
  "materials": [{"name": "glass", "youngs_modulus": "10 MPa", "density": "2.5 g/cm^3"}],
  "spheres": [
    {"diameter": "1 mm", "position": [0, 0, "2 mm"], "velocity": [0, 0, "-10 cm/s"]},
    {"diameter": 1e-3, "position": [0, 0, "0.5 mm"], "material": "glass"}],
  "walls": [{"shape": "plane"},
            {"shape": "open_cylinder", "diameter": "1 cm", "length": "2 cm", "direction": [0, 0, 5],
             "motion": [{"time": 0.1, "velocity": [0, 0, "1 cm/s"]}]}],
  "stop": {"time": 0.1}
})";

// What a scene leaves is where another may start from.
TEST(SceneJson, SpheresComeFromFilesWithTheirMaterials) {
  const std::filesystem::path folder = ::testing::TempDir();
  base::WriteFileAtomically(folder / "state.csv",
                            "id,type,x_m,y_m,z_m,diameter_m,vx_m_per_s,wy_rad_per_s\n"
                            "7,1,0.01,0.02,0.03,0.002,0.5,-4\n3,0,0,0,0.01,0.001,0,0\n");
  base::WriteFileAtomically(folder / "radii.csv", "radius_m,x_m,y_m,z_m\r\n0.003,0,0,0.1\r\n");
  const Scene scene = LoadScene(Write(R"({
    "materials": [{"name": "sand"}, {"name": "steel", "density": 7800}],
    "pairs": [{"between": ["sand", "steel"], "sliding_friction": 0.2}],
    "spheres": [{"diameter": "1 mm", "position": [0, 0, 1]}],
    "sphere_files": [{"file": "state.csv"}, {"file": "radii.csv", "material": "steel"}],
    "stop": {"time": 1}})"))
                          .scene;
  ASSERT_EQ(scene.particles.size(), 4u);
  EXPECT_EQ(scene.particles[1].material, 1);
  EXPECT_EQ(scene.particles[1].radius, 0.001);
  EXPECT_EQ(scene.particles[1].position, (Vec3{0.01, 0.02, 0.03}));
  EXPECT_EQ(scene.particles[1].velocity, (Vec3{0.5, 0, 0}));
  EXPECT_EQ(scene.particles[1].angular_velocity, (Vec3{0, -4, 0}));
  EXPECT_EQ(scene.particles[2].material, 0);
  EXPECT_EQ(scene.particles[3].material, 1);
  EXPECT_EQ(scene.particles[3].radius, 0.003);
}

TEST(SceneJson, BadSphereFilesAreNamedWithTheLine) {
  const std::filesystem::path folder = ::testing::TempDir();
  const auto error = [&](const std::string& table) {
    base::WriteFileAtomically(folder / "bad.csv", table);
    return ErrorOf(
        R"({"materials": [{"name": "sand"}], "domain": {"low": [-1, -1, -1], "high": [1, 1, 1]},
                       "sphere_files": [{"file": "bad.csv"}], "stop": {"time": 1}})");
  };
  EXPECT_THAT(error(""), AllOf(HasSubstr("bad.csv"), HasSubstr("no column x_m")));
  EXPECT_THAT(error("x_m,y_m,z_m\n0,0,0\n"), HasSubstr("no column diameter_m or radius_m"));
  EXPECT_THAT(error("x_m,y_m,z_m,x_m,radius_m\n"), HasSubstr("column x_m twice"));
  EXPECT_THAT(error("x_m,y_m,z_m,radius_m\n\n"), HasSubstr("has no spheres"));
  EXPECT_THAT(error("x_m,y_m,z_m,radius_m\n0,0,0\n"), HasSubstr("line 2: has 3 columns"));
  EXPECT_THAT(error("x_m,y_m,z_m,radius_m\n0,0,nan,1\n"), HasSubstr("line 2: z_m is \"nan\""));
  EXPECT_THAT(error("x_m,y_m,z_m,radius_m\n0,0,0,-1\n"), HasSubstr("must be positive"));
  EXPECT_THAT(error("x_m,y_m,z_m,radius_m,diameter_m\n0,0,0,1e-3,1e-3\n"),
              HasSubstr("line 2: diameter_m is not twice radius_m"));
  EXPECT_THAT(error("x_m,y_m,z_m,radius_m,type\n0,0,0,1,1\n"), HasSubstr("line 2: type"));
  EXPECT_THAT(error("x_m,y_m,z_m,radius_m\n0,0,5,0.1\n"), HasSubstr("outside the domain"));
}

// They stood as spheres[1] and spheres[2] of a file that has one.
TEST(SceneJson, SpheresOfAFileAreNamedAsSuch) {
  base::WriteFileAtomically(std::filesystem::path(::testing::TempDir()) / "near.csv",
                            "x_m,y_m,z_m,radius_m\n0,0,1,0.1\n0,0,1.05,0.1\n");
  EXPECT_THAT(ErrorOf(R"({"materials": [{"name": "sand"}],
                          "spheres": [{"diameter": "1 mm", "position": [0, 0, 0]}],
                          "sphere_files": [{"file": "near.csv"}], "stop": {"time": 1}})"),
              HasSubstr("sphere_files: one of their spheres overlaps a sphere of sphere_files"));
}

TEST(SceneJson, ATimeToHoldWithoutWhatIsHeldIsRefused) {
  EXPECT_THAT(
      ErrorOf(
          R"({"materials": [{"name": "sand"}], "domain": {"low": [-1, -1, -1], "high": [1, 1, 1]},
                  "stop": {"time": 1, "hold_time": "20 ms"}})"),
      HasSubstr("stop.hold_time: is of energy_fraction"));
}

TEST(SceneJson, ReadsSpheresWallsAndUnits) {
  const Scene scene = LoadScene(Write(kPair)).scene;
  ASSERT_EQ(scene.particles.size(), 2u);
  EXPECT_EQ(scene.particles[0].radius, 0.5e-3);
  EXPECT_EQ(scene.particles[0].velocity, (Vec3{0, 0, -0.1}));
  EXPECT_EQ(scene.materials[0].density, 2500);
  const auto& tube = std::get<OpenCylinder>(scene.walls.at(1).shape);
  EXPECT_EQ(tube.axis, (Vec3{0, 0, 1}));
  EXPECT_EQ(tube.radius, 5e-3);
  EXPECT_EQ(scene.walls[1].motion.at(0).velocity, (Vec3{0, 0, 0.01}));
}

TEST(SceneJson, FillsAreDrawnIntoTheirRegion) {
  const Scene scene = LoadScene(Write(R"({
    "materials": [{"name": "a"}, {"name": "b", "density": 2000}],
    "fills": [{"material": "b", "mass": "0.4 g", "region": {"diameter": "1 cm"},
               "sizes": {"kind": "uniform", "min": "0.8 mm", "max": "1.2 mm"}}],
    "walls": [{"shape": "plane"}], "stop": {"steps": 10}})"))
                          .scene;
  double volume = 0;
  for (const Particle& p : scene.particles) {
    volume += 4.0 / 3 * std::numbers::pi * p.radius * p.radius * p.radius;
    EXPECT_EQ(p.material, 1);
  }
  EXPECT_NEAR(volume * 2000, 0.4e-3, 1.5e-6);  // to within one grain, at most 1.8 µg
}

// Places were found in time that grew as the square: 5000 spheres took 12 s, and a million more
// than any test may take.
TEST(SceneJson, AMillionListedSpheresAreRead) {
  constexpr int kNumSpheres = 1000000;
  std::string text = R"({"materials": [{"name": "a"}], "stop": {"steps": 1}, "spheres": [)";
  for (int i = 0; i < kNumSpheres; ++i) {
    text += std::string(i == 0 ? "\n" : ",\n") + R"({"diameter": 1e-3, "position": [)" +
            std::to_string(i % 1000) + "," + std::to_string(i / 1000) + ",1]}";
  }
  const auto spec = base::LoadOptions<SceneSpec>(base::ParseJson(text + "]}", "scene.json"));
  EXPECT_EQ(spec.spheres.size(), static_cast<std::size_t>(kNumSpheres));
}

TEST(SceneJson, TheWrittenSceneIsReadBackTheSame) {
  const LoadedScene loaded = LoadScene(Write(kPair));
  const std::string text = SceneText(loaded.spec);
  EXPECT_EQ(SceneText(LoadScene(Write(text)).spec), text);
}

TEST(SceneJson, EveryProblemOfAFileIsListedByPath) {
  EXPECT_THAT(ErrorOf(R"({
    "materials": [{"name": "a", "poisson_ratio": 0.7, "density": -1}, {"name": "a"}],
    "spheres": [{"diameter": -1, "position": [0, 0, 0], "material": "b"},
                {"diametr": 1, "position": [0, 0]}],
    "walls": [{"shape": "disc"}, {"shape": "plane", "direction": [0, 0, 0]}],
    "domain": {"low": [1, 0, 0], "high": [1, 1, 1]}, "gravityy": [0, 0, 0], "stop": {}})"),
              AllOf(HasSubstr("materials[0].poisson_ratio: is 0.7, must be in (-1, 0.5]"),
                    HasSubstr("materials[0].density: is -1"), HasSubstr("materials[1].name"),
                    HasSubstr("spheres[0].diameter: is -1, must be positive"),
                    HasSubstr("spheres[0].material: \"b\" is not the name of a material"),
                    HasSubstr("spheres[1].diametr: is not known here; did you mean \"diameter\"?"),
                    HasSubstr("spheres[1].position: must be a list of three numbers"),
                    HasSubstr("walls[0].diameter: is missing"), HasSubstr("walls[1].direction"),
                    HasSubstr("domain.low: must be below high in each coordinate"),
                    HasSubstr("spheres[0].position: is outside the domain"),
                    HasSubstr("gravityy: is not known here; did you mean \"gravity\"?"),
                    HasSubstr("stop: must have time or steps")));
}

TEST(SceneJson, WhatTheSolverRefusesIsNamedByItsPlaceInTheFile) {
  const auto scene = [](const std::string& spheres, const std::string& more) {
    return R"({"materials": [{"name": "a"}], "walls": [{"shape": "plane"}], "stop": {"steps": 1},
              "spheres": [)" +
           spheres + "]" + more + "}";
  };
  const std::string one = R"({"diameter": 1e-3, "position": [0, 0, 1e-3]})";
  EXPECT_EQ(ErrorOf(scene(one, "")), "");
  EXPECT_THAT(ErrorOf(scene(one + "," + one, "")), HasSubstr("spheres["));  // overlap
  EXPECT_THAT(ErrorOf(scene(R"({"diameter": 1e-3, "position": [0, 0, -1e-3]})", "")),
              HasSubstr("spheres[0]"));  // escaped through the plane
  EXPECT_THAT(ErrorOf(scene(one, R"(, "time_step": "1 ms")")), HasSubstr("time_step"));
}

TEST(SceneJson, AFillWithoutRoomSaysSo) {
  EXPECT_THAT(ErrorOf(R"({
    "materials": [{"name": "a"}], "walls": [{"shape": "plane"}], "stop": {"steps": 1},
    "fills": [{"mass": "1 g", "region": {"diameter": "5 mm", "height": "5 mm"},
               "sizes": {"kind": "mono", "diameter": "1 mm"}}]})"),
              HasSubstr("fills[0].mass: is 0.001, must be less"));
  // Grains in a tube of which they fill a third at most; it was told to leave its height out.
  EXPECT_THAT(ErrorOf(R"({
    "materials": [{"name": "a"}], "walls": [{"shape": "plane"}], "stop": {"steps": 1},
    "fills": [{"mass": "0.3 g", "region": {"diameter": "1.5 mm"}, "solid_fraction": 0.6,
               "sizes": {"kind": "mono", "diameter": "1 mm"}}]})"),
              HasSubstr("fills[0].solid_fraction: was not reached without overlaps; give a lower "
                        "one, such as 0.55"));
}

// Filling millions of grains into a tower takes minutes, and is hardly what was meant.
TEST(SceneJson, AFillThatStandsAHundredWidthsHighIsRefusedUnlessItsHeightIsGiven) {
  const auto error_of = [](const std::string& mass, const std::string& more = "") {
    return ErrorOf(R"({"materials": [{"name": "a"}], "walls": [{"shape": "plane"}],
                       "stop": {"steps": 1}, "fills": [{"mass": ")" +
                   mass + R"(", "region": {"diameter": "5 mm")" + more +
                   R"(}, "sizes": {"kind": "mono", "diameter": "1 mm"}}]})");
  };
  EXPECT_EQ(error_of("0.5 g"), "");
  EXPECT_THAT(error_of("0.5 kg"), HasSubstr("fills[0].mass: is 0.5, in kg, which stands"));
  EXPECT_THAT(error_of("15 g"), HasSubstr("m high in a region of 5 mm"));  // 0.56 m
  EXPECT_EQ(error_of("1 g", R"(, "height": "1 m")"), "");
}

TEST(SceneJson, WhatManySpheresOfAFillDoIsSaidOnce) {
  const std::string error = ErrorOf(R"({
    "materials": [{"name": "a"}], "stop": {"steps": 1},
    "walls": [{"name": "lid", "shape": "plane", "position": [0, 0, "5 mm"]}],
    "fills": [{"mass": "0.1 g", "region": {"diameter": "5 mm"},
               "sizes": {"kind": "mono", "diameter": "0.5 mm"}}]})");
  EXPECT_THAT(error, HasSubstr("fills: a sphere stands in the wall \"lid\""));
  EXPECT_EQ(error.find("a sphere"), error.rfind("a sphere"));
}

TEST(SceneJson, MissingFileAndBrokenJsonAreErrors) {
  EXPECT_THROW(LoadScene("/nowhere/scene.json"), base::ConfigError);
  EXPECT_THAT(ErrorOf("{"), HasSubstr("is not JSON"));
}

// The shipped schema is made from the Visit lists that the parser walks. After a change, run this
// test with TALUS_UPDATE_SCHEMAS=1 and commit what it writes.
TEST(SceneJson, TheShippedSchemaIsTheParsers) {
  const std::string path = TALUS_SOURCE_DIR "/docs/scene.schema.json";
  const std::string schema = base::FileSchema<SceneSpec>("talus scene").dump(2) + "\n";
  if (std::getenv("TALUS_UPDATE_SCHEMAS") != nullptr) base::WriteFileAtomically(path, schema);
  EXPECT_TRUE(base::ReadFile(path) == schema) << path << ": TALUS_UPDATE_SCHEMAS=1 makes it anew";
}

TEST(SceneJson, TheShippedExamplesAreValid) {
  for (const char* name : {"bouncing_pair.json", "packing.json", "drum.json", "hopper.json",
                           "draw_down.json", "column_collapse.json", "tilting_box.json"}) {
    EXPECT_NO_THROW(LoadScene(std::string(TALUS_SOURCE_DIR "/examples/scenes/") + name)) << name;
  }
}

}  // namespace scene_json_test
}  // namespace talus::engine
