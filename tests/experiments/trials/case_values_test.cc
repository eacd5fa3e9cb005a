// What templates are told of a case.
#include "experiments/trials/engines/case_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "base/files/file.h"
#include "base/json/json_schema.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/trials/engines/command_case.h"
#include "tests/experiments/command_fixture.h"

namespace talus::trials {
namespace case_values_test {

TEST(CaseValues, SeedsSuitTheCodesThatTakeThem) {
  rigs::Case rig_case = SmallCase();
  std::set<std::string> primes;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    rig_case.seed = seed;
    const TemplateValues values = CaseValues(rig_case);
    const long prime = std::stol(values.scalars.at("prime_seed"));
    EXPECT_GT(prime, 10000);
    for (long d = 2; d * d <= prime; ++d) ASSERT_NE(prime % d, 0);
    primes.insert(values.scalars.at("prime_seed"));
  }
  EXPECT_EQ(primes.size(), 50u);
  rig_case.seed = ~std::uint64_t{0};
  const long seed = std::stol(CaseValues(rig_case).scalars.at("seed"));
  EXPECT_TRUE(seed > 0 && seed < 900000000) << seed;
}

// 2 · 0.5 · 0.125 / (0.5 + 0.125) = 0.2 where the pair does not state it (P5).
TEST(CaseValues, PairsAreStatedOrMixed) {
  rigs::Case rig_case = SmallCase();
  rig_case.materials.floor = rigs::WallMaterial{.sliding_friction = 0.125};
  EXPECT_DOUBLE_EQ(std::stod(CaseValues(rig_case).scalars.at("plate_pair_sliding_friction")), 0.2);
  EXPECT_THAT(StatedPlaceholders(rig_case), ::testing::IsEmpty());
  rigs::PairWith(rig_case.pairs, rigs::kFloor).sliding_friction = 0.25;
  EXPECT_EQ(CaseValues(rig_case).scalars.at("plate_pair_sliding_friction"), "0.25");
  EXPECT_EQ(CaseValues(rig_case).scalars.at("plate_sliding_friction"), "0.125");
  EXPECT_THAT(StatedPlaceholders(rig_case), ::testing::ElementsAre("plate_pair_sliding_friction"));
}

TEST(CaseValues, CoarseGrainingAndWallsAreApplied) {
  rigs::Case rig_case = SmallCase();
  rig_case.coarse_graining.scale_factor = 2;
  rig_case.powder.material.surface_energy = 1e-4;
  rig_case.materials.floor = rigs::WallMaterial{.sliding_friction = 0.125};
  TemplateValues values = CaseValues(rig_case);
  EXPECT_EQ(std::stod(values.scalars.at("mean_diameter")), 2e-3);
  EXPECT_EQ(std::stod(values.scalars.at("surface_energy_used")), 2e-4);
  EXPECT_EQ(values.scalars.at("plate_sliding_friction"), "0.125");
  EXPECT_EQ(values.scalars.at("tube_sliding_friction"), "0.5");
  AddGrains(rig_case, values);
  const TemplateTable& grains = values.tables.at("grains");
  EXPECT_EQ(std::to_string(grains.rows.size()), values.scalars.at("num_grains"));
  EXPECT_EQ(std::stod(grains.rows.at(0).at(4)), 2e-3);
}

// That of a case of talus, which another engine may simulate. After a change, run with
// TALUS_UPDATE_SCHEMAS=1 and commit what it writes.
TEST(CommandCase, TheShippedSchemaOfACaseIsTheParsers) {
  const std::string path = TALUS_SOURCE_DIR "/docs/case.schema.json";
  auto schema = base::FileSchema<CommandCase>("talus heap case");
  schema["required"] = base::FileSchema<rigs::Case>("")["required"];
  const std::string text = schema.dump(2) + "\n";
  if (std::getenv("TALUS_UPDATE_SCHEMAS") != nullptr) base::WriteFileAtomically(path, text);
  EXPECT_TRUE(base::ReadFile(path) == text) << path << ": TALUS_UPDATE_SCHEMAS=1 makes it anew";
}

}  // namespace case_values_test
}  // namespace talus::trials
