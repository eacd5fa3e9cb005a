#include "experiments/rigs/lifted_tube/heap_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_schema.h"
#include "experiments/rigs/lifted_tube/heap_result.h"
#include "experiments/rigs/lifted_tube/heap_scene.h"

namespace talus::rigs {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kExample = TALUS_SOURCE_DIR "/examples/scenes/heap_case.json";

std::filesystem::path Write(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream(path) << text;
  return path;
}

std::string ErrorOf(const std::string& text) {
  try {
    LoadHeapCase(Write("heap_case_error.json", text));
  } catch (const base::ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(HeapCase, TheCompleteTextIsTheSameCase) {
  const HeapCase heap_case = LoadHeapCase(kExample);
  const std::string text = HeapCaseText(heap_case);
  const HeapCase again = LoadHeapCase(Write("heap_case_complete.json", text));
  EXPECT_EQ(HeapCaseText(again), text);
  EXPECT_EQ(HeapCaseHash(again), HeapCaseHash(heap_case));
}

TEST(HeapCase, ASizeFileMovesIntoTheCase) {
  Write("heap_case_sizes.csv", "diameter (um),% under\n400,0\n500,50\n600,100\n");
  const HeapCase heap_case = LoadHeapCase(Write("heap_case_file.json", R"({"powder": {
    "sizes": {"kind": "file", "file": "heap_case_sizes.csv"}, "mass": "0.5 g"}})"));
  EXPECT_EQ(heap_case.powder.sizes.kind, engine::SizeKind::kCumulative);
  EXPECT_THAT(HeapCaseText(heap_case), ::testing::Not(HasSubstr("heap_case_sizes")));
}

TEST(HeapCase, HashIgnoresWhatDoesNotChangeTheHeap) {
  HeapCase heap_case = LoadHeapCase(kExample);
  const std::uint64_t hash = HeapCaseHash(heap_case);
  heap_case.threads = 2;
  heap_case.checkpoint_interval = 1;
  EXPECT_EQ(HeapCaseHash(heap_case), hash);
  heap_case.seed = 2;
  EXPECT_NE(HeapCaseHash(heap_case), hash);
}

TEST(HeapCase, EveryProblemIsListed) {
  EXPECT_THAT(ErrorOf(R"({"powder": {"material": {"poisson_ratio": 0.6},
                          "sizes": {"kind": "mono"}, "mass": -1},
                          "device": {"tube_inner_diameter": "12 mm"},
                          "rules": {"heap": {"hold_time": 0}}, "num_views": 0, "sead": 1})"),
              AllOf(HasSubstr("powder.material.poisson_ratio"),
                    HasSubstr("powder.sizes.diameter: is missing"),
                    HasSubstr("powder.mass: is -1, must be positive"),
                    HasSubstr("device.tube_inner_diameter: is 0.012, must not be above"),
                    HasSubstr("rules.heap.hold_time"), HasSubstr("num_views"),
                    HasSubstr("sead: is not known here; did you mean \"seed\"?")));
}

TEST(HeapCase, ADeviceThatCannotHoldTheMassIsRefused) {
  const std::string powder =
      R"("powder": {"sizes": {"kind": "mono", "diameter": "0.5 mm"}, "mass": "1 g"})";
  EXPECT_EQ(ErrorOf("{" + powder + "}"), "");
  EXPECT_THAT(ErrorOf("{" + powder + R"(, "device": {"tube_length": "2 mm"}})"),
              HasSubstr("device.tube_length: is 0.002, cannot hold the mass"));
  EXPECT_THAT(ErrorOf("{" + powder + R"(, "coarse_graining": {"scale_factor": 8}})"),
              HasSubstr("must be above three (scaled) grain diameters"));
}

TEST(HeapScene, CoarseGrainingScalesDiametersAndSurfaceEnergyAndKeepsTheMass) {
  HeapCase heap_case = LoadHeapCase(kExample);
  heap_case.powder.material.surface_energy = 1e-4;
  const FilledScene fine = MakeHeapScene(heap_case);
  heap_case.coarse_graining.scale_factor = 2;
  const FilledScene coarse = MakeHeapScene(heap_case);
  const auto mass = [&](const FilledScene& made) {
    double volume = 0;
    for (const engine::Particle& p : made.scene.particles) volume += std::pow(p.radius, 3);
    return 4.0 / 3 * std::numbers::pi * volume * heap_case.powder.material.density;
  };
  EXPECT_NEAR(static_cast<double>(fine.scene.particles.size()) /
                  static_cast<double>(coarse.scene.particles.size()),
              8, 0.1);  // a few hundred grains: one of them is 0.3 %
  EXPECT_NEAR(mass(fine) / mass(coarse), 1, 0.005);
  EXPECT_EQ(coarse.scene.materials[0].surface_energy, 2e-4);
  heap_case.coarse_graining.surface_energy_exponent = 2;
  EXPECT_EQ(UsedMaterial(heap_case).surface_energy, 4e-4);
  EXPECT_EQ(fine.scene.materials[0].youngs_modulus, coarse.scene.materials[0].youngs_modulus);
}

TEST(HeapScene, WallsTakeThePowdersMaterialWhereTheyHaveNoneOfTheirOwn) {
  HeapCase heap_case = LoadHeapCase(kExample);
  heap_case.device.plate_material = WallMaterial{.sliding_friction = 0.9};
  const engine::Scene scene = MakeHeapScene(heap_case).scene;
  const auto& tube = scene.materials[static_cast<std::size_t>(scene.walls[kTube].material)];
  const auto& plate = scene.materials[static_cast<std::size_t>(scene.walls[kPlate].material)];
  EXPECT_EQ(tube.sliding_friction, heap_case.powder.material.sliding_friction);
  EXPECT_EQ(plate.sliding_friction, 0.9);
  EXPECT_EQ(plate.rolling_friction, heap_case.powder.material.rolling_friction);
}

TEST(HeapScene, WarnsWhenTheGrainsAreTooFewAcrossThePlate) {
  HeapCase heap_case = LoadHeapCase(kExample);
  heap_case.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 0.3e-3};  // 33 across
  EXPECT_TRUE(HeapWarnings(heap_case).empty());
  heap_case.coarse_graining.scale_factor = 2;  // 17 across
  EXPECT_THAT(HeapWarnings(heap_case).at(0),
              HasSubstr("only 16.7 grains across the plate at scale factor 2: a smaller scale "
                        "factor would say more (30 or more are advised)"));
  heap_case.coarse_graining.scale_factor = 3;  // 11 across
  EXPECT_THAT(HeapWarnings(heap_case).at(0), HasSubstr("COARSE"));
  EXPECT_TRUE(SetUpWarnings(heap_case).empty());
  heap_case.coarse_graining.scale_factor = 1;
  heap_case.powder.sizes.diameter = 0.5e-3;  // nothing finer can be simulated
  EXPECT_THAT(HeapWarnings(heap_case).at(0), HasSubstr("a wider tube and plate would say more"));
}

// Grains of 0.3 mm, 2000 kg/m³, in a tube of 10 mm: F_po / (d² ρ g D) = πγ/(d ρ g D) is 0.2 at
// γ = 3.75e-3 J/m², whatever the scale factor.
TEST(HeapScene, WarnsWhenACohesivePowderIsPlacedDensely) {
  HeapCase heap_case = LoadHeapCase(kExample);
  heap_case.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 0.3e-3};
  heap_case.powder.material.density = 2000;
  heap_case.models.adhesion = engine::Adhesion::kJkr;
  for (const double scale_factor : {1.0, 1.1}) {
    heap_case.coarse_graining.scale_factor = scale_factor;
    heap_case.powder.material.surface_energy = 3.6e-3;
    EXPECT_TRUE(HeapWarnings(heap_case).empty());
    heap_case.powder.material.surface_energy = 3.9e-3;
    EXPECT_THAT(HeapWarnings(heap_case).at(0), HasSubstr("COHESIVE"));
  }
  heap_case.filling.kind = FillingKind::kPour;
  EXPECT_TRUE(HeapWarnings(heap_case).empty());
  heap_case.filling.kind = FillingKind::kDense;
  heap_case.models.adhesion = engine::Adhesion::kNone;
  EXPECT_THAT(HeapWarnings(heap_case), Not(Contains(HasSubstr("COHESIVE"))));
}

// After a change, run with TALUS_UPDATE_SCHEMAS=1 and commit what it writes.
TEST(HeapCase, TheShippedSchemaIsTheParsers) {
  const std::string path = TALUS_SOURCE_DIR "/docs/case.schema.json";
  const std::string schema = base::FileSchema<HeapCase>("talus heap case").dump(2) + "\n";
  if (std::getenv("TALUS_UPDATE_SCHEMAS") != nullptr) base::WriteFileAtomically(path, schema);
  EXPECT_EQ(base::ReadFile(path), schema);
}

}  // namespace
}  // namespace talus::rigs
