#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/files/file.h"
#include "base/json/json_schema.h"
#include "experiments/campaign/plan/campaign_strategy.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/campaign/spec/deck_gaps.h"
#include "experiments/campaign/spec/measured_numbers.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "tests/error_in.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::campaign {
namespace spec_test {

using ::testing::HasSubstr;

constexpr const char* kGood = R"({
  "experiment": {"map": "map.png", "plate_diameter": "10 mm"},
  "powder": {"material": {"density": 4386, "youngs_modulus": "26.25 MPa"},
             "sizes": {"kind": "mono", "diameter": "400 um"}, "mass": "1.5 g"},
  "models": {"adhesion": "dmt"}
})";

CampaignSpec Read(const std::string& text) {
  return ReadCampaignSpec(base::ParseJson(text, "/folder/powder.json"));
}

std::string With(const std::string& member) {
  std::string text = kGood;
  return text.insert(1, "\n  " + member + ",");
}

std::string ErrorOf(const std::string& text) {
  return ErrorIn([&] { Read(text); });
}

TEST(Spec, DefaultsAreTheThreeUsualParametersAndTheFilesName) {
  const CampaignSpec spec = Read(kGood);
  EXPECT_EQ(spec.name, "powder");
  EXPECT_EQ(spec.experiment->map, "/folder/map.png");  // relative to the spec
  const auto space = SpaceOf(spec);
  ASSERT_EQ(space.Free().size(), 3u);
  EXPECT_EQ(space.parameters[2].name, "surface_energy");
  EXPECT_EQ(space.parameters[2].scale, optimizer::Scale::kLog);
  EXPECT_DOUBLE_EQ(space.parameters[2].high, 40e-5);
}

TEST(Spec, AnySubsetOfTheMaterialWithUnitsAndFixedValues) {
  const CampaignSpec spec = Read(With(R"("parameters": {
    "surface_energy": {"min": "1 uJ/m^2", "max": "40e-5 J/m^2", "scale": "log"},
    "youngs_modulus": {"min": "1 MPa", "max": "30 MPa", "guess": "10 MPa"},
    "restitution": {"fixed": 0.6}})"));
  const auto space = SpaceOf(spec);
  ASSERT_EQ(space.Free().size(), 2u);
  const std::vector<double> values = space.ToNative(Eigen::Vector2d(0.5, 1));
  const rigs::Case c = CaseOf(spec, {.values = values, .seed = 7, .scale_factor = 2}, {});
  EXPECT_NEAR(c.powder.material.surface_energy, 2e-5, 1e-15);  // √(1e-6 · 4e-4)
  EXPECT_DOUBLE_EQ(c.powder.material.youngs_modulus, 30e6);
  EXPECT_DOUBLE_EQ(c.powder.material.restitution, 0.6);
  EXPECT_EQ(c.seed, 7u);
  EXPECT_EQ(c.coarse_graining.scale_factor, 2);
  EXPECT_EQ(UnitOf("surface_energy"), "J/m^2");
  EXPECT_EQ(UnitOf("sliding_friction"), "");
}

// Heaps of two masses; one of them weighed three times: mean 21, standard error √(7/3).
TEST(Spec, AnExperimentHasItsOwnMassAndItsRepeatedNumbers) {
  const CampaignSpec spec = Read(R"({
    "experiments": [
      {"name": "small", "map": "a.png", "plate_diameter": "10 mm", "mass": "0.5 g"},
      {"name": "large", "mass": "1 g", "mass_fallen": {"values": ["18 mg", "23 mg", "22 mg"]}}],
    "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "400 um"}},
    "parameters": {"sliding_friction": {"min": 0.1, "max": 0.5}}})");
  EXPECT_DOUBLE_EQ(TypicalCase(spec, 0, 1).powder.mass, 0.5e-3);
  EXPECT_DOUBLE_EQ(TypicalCase(spec, 1, 1).powder.mass, 1e-3);
  const ScalarSpec fallen = ScalarsOf(ExperimentsOf(spec)[1]).front();
  EXPECT_NEAR(fallen.value, 21e-6, 1e-15);
  EXPECT_NEAR(fallen.standard_error, std::sqrt(7.0 / 3) * 1e-6, 1e-15);
}

// A test of 20 g was filled with the 1.6 g that are searched.
TEST(Spec, ASearchedMassStandsBesideNoTestsOwn) {
  const std::string error = ErrorOf(R"({
    "experiments": [
      {"name": "heap", "map": "a.png", "plate_diameter": "10 mm"},
      {"name": "large", "mass": "1 g", "mass_fallen": {"values": ["18 mg", "23 mg", "22 mg"]}}],
    "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "400 um"},
               "mass": "0.5 g"},
    "parameters": {"mass": {"min": "0.4 g", "max": "0.6 g"}}})");
  EXPECT_THAT(error, HasSubstr("experiments[1].mass: stands beside parameters.mass"));
}

// Grains of 2500 kg/m³ cannot lie at 2600, but those that are searched may be heavier.
TEST(Spec, ADensityIsHeldToTheHeaviestGrainsThatAreSearched) {
  const auto with = [](const char* parameter) {
    return std::string(R"({
      "experiments": [{"name": "tapped", "rig": {"kind": "tapped_density"},
                       "tapped_density": {"value": 2600, "sd": 20}}],
      "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "400 um"},
                 "mass": "20 g"},
      "parameters": {"sliding_friction": {"min": 0.1, "max": 0.5})") +
           parameter + "}}";
  };
  EXPECT_THAT(ErrorOf(with("")), HasSubstr("must be below the grains' 2500"));
  EXPECT_EQ(ErrorOf(with(R"(, "density": {"min": 2400, "max": 5000})")), "");
}

TEST(Spec, WhatFillsADrumIsGivenOnce) {
  const auto with = [](const char* rig, const char* of_test, const char* parameters) {
    return std::string(R"({
      "experiments": [{"name": "drum", "angle": {"value": "33 deg", "sd": "1 deg"},
                       "rig": {"kind": "drum", "diameter": "40 mm", "width": "8 mm",
                               "speed": "15 rpm")") +
           rig + "}" + of_test + R"(}],
      "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "2 mm"}},
      "parameters": {"sliding_friction": {"min": 0.1, "max": 0.5})" +
           parameters + "}}";
  };
  constexpr const char* kFill = R"(, "fill": {"min": 0.3, "max": 0.4})";
  EXPECT_EQ(ErrorOf(with("", "", kFill)), "");
  EXPECT_EQ(ErrorOf(with("", "", R"(, "mass": {"min": "4 g", "max": "6 g"})")), "");
  EXPECT_THAT(ErrorOf(with(R"(, "fill": 0.3)", "", kFill)),
              HasSubstr("experiments[0].rig.fill: stands beside parameters.fill"));
  EXPECT_THAT(ErrorOf(with("", R"(, "mass": "5 g")", kFill)),
              HasSubstr("experiments[0].mass: stands beside parameters.fill"));
  EXPECT_THAT(ErrorOf(with(R"(, "fill": 0.3)", "", R"(, "mass": {"min": "4 g", "max": "6 g"})")),
              HasSubstr("parameters.mass: has no effect: every test is a drum"));
}

TEST(Spec, WhatTheContactLawsDoNotAskForIsNotSearched) {
  const auto with = [](const std::string& rolling, const std::string& parameter) {
    std::string text = With(R"("parameters": {"sliding_friction": {"min": 0.1, "max": 0.5}, ")" +
                            parameter + R"(": {"min": 0.1, "max": 0.2}})");
    const std::string dmt = R"({"adhesion": "dmt"})";
    return text.replace(text.find(dmt), dmt.size(), R"({"rolling": ")" + rolling + R"("})");
  };
  EXPECT_THAT(
      ErrorOf(with("constant", "rolling_damping")),
      HasSubstr("parameters.rolling_damping: has no effect but with models.rolling \"epsd\""));
  EXPECT_THAT(ErrorOf(with("none", "plate_pair_rolling_friction")),
              HasSubstr("parameters.plate_pair_rolling_friction: has no effect without a rolling"));
  EXPECT_EQ(ErrorOf(with("epsd", "rolling_damping")), "");
}

CampaignSpec WithDeckIn(const std::filesystem::path& folder) {
  CampaignSpec spec = Read(kGood);
  spec.engine.kind = EngineKind::kCommand;
  spec.engine.command.command = {"sh", "run.sh"};
  spec.engine.command.templates = folder;
  return spec;
}

TEST(Spec, DecksThatTakeNoSeedOrNoGrainSizeAreWarnedOf) {
  const ScratchFolder scratch;
  CampaignSpec spec = WithDeckIn(scratch.path());
  const auto warnings = [&](const char* deck) {
    std::ofstream(scratch.path() / "run.sh") << deck;
    return DeckWarnings(spec);
  };
  ASSERT_EQ(warnings("{{ sliding_friction }}").size(), 1u);
  EXPECT_THAT(warnings("{{ sliding_friction }}")[0], HasSubstr("are one run again"));
  EXPECT_TRUE(warnings("{{ prime_seed }}").empty());
  spec.coarse_graining.scale_factors = {3, 2};
  ASSERT_EQ(warnings("{{ seed }}").size(), 1u);
  EXPECT_THAT(warnings("{{ seed }}")[0], HasSubstr("trials at all scale factors are the same"));
  EXPECT_TRUE(warnings("{{ seed }} {{ mean_diameter }}").empty());
  EXPECT_TRUE(warnings("{{# grains }}{{ radius }}{{/ grains }}").empty());
}

// A drum was predicted with the deck of a lifted tube: the tube again.
TEST(Spec, ADeckIsToldOfWhatMakesAProcessAnotherTest) {
  const ScratchFolder scratch;
  CampaignSpec spec = WithDeckIn(scratch.path());
  rigs::Case other = TypicalCase(spec, 0, spec.coarse_graining.Levels().front());
  const auto untold = [&](const char* deck) {
    std::ofstream(scratch.path() / "run.sh") << deck;
    return DeckGapOf(spec, other).untold;
  };
  EXPECT_EQ(untold("{{ seed }}"), "");
  other.powder.mass *= 2;
  EXPECT_EQ(untold("{{ num_grains }}"), "");
  EXPECT_THAT(untold("{{ seed }}"), HasSubstr("{{ mass }}"));
  EXPECT_FALSE(DeckGapOf(spec, other).is_other_rig);
  other.powder.mass /= 2;
  other.rig.kind = rigs::RigKind::kDrum;
  EXPECT_THAT(untold("{{ seed }}"), HasSubstr("{{ rig_kind }}"));
  EXPECT_TRUE(DeckGapOf(spec, other).is_other_rig);
  EXPECT_EQ(untold("{{ rig_kind }}"), "");
  EXPECT_FALSE(DeckGapOf(spec, other).is_other_rig);
  spec.engine.kind = EngineKind::kTalus;
  EXPECT_EQ(untold("{{ seed }}"), "");
}

TEST(Spec, PlateAndTubeHaveParametersOfTheirOwn) {
  const CampaignSpec spec = Read(With(R"("device": {"plate_material": {"restitution": 0.4}},
    "parameters": {
    "sliding_friction": {"min": 0.1, "max": 0.5},
    "plate_sliding_friction": {"min": 0.2, "max": 0.8},
    "tube_surface_energy": {"fixed": "1e-4 J/m^2"}})"));
  const auto space = SpaceOf(spec);
  ASSERT_EQ(space.Free().size(), 2u);
  const std::vector<double> values = space.ToNative(Eigen::Vector2d(0.5, 0.5));
  const rigs::Case c = CaseOf(spec, {.values = values, .seed = 7, .scale_factor = 2}, {});
  EXPECT_DOUBLE_EQ(c.powder.material.sliding_friction, 0.3);
  EXPECT_DOUBLE_EQ(c.materials.floor.value().sliding_friction.value(), 0.5);
  EXPECT_DOUBLE_EQ(c.materials.floor.value().restitution.value(), 0.4);  // the device's stays
  EXPECT_FALSE(c.materials.floor.value().surface_energy);                // follows the powder
  EXPECT_DOUBLE_EQ(c.materials.walls.value().surface_energy.value(), 1e-4);
  EXPECT_EQ(UnitOf("plate_surface_energy"), "J/m^2");
  EXPECT_THAT(ErrorOf(With(R"("parameters": {"plate_sliding_friction": {"min": -1, "max": 1}})")),
              HasSubstr("parameters.plate_sliding_friction.min"));
}

// An experiment's own pairs stand in place of the campaign's; what is searched holds in all.
TEST(Spec, PairsAreStatedOrSearched) {
  const CampaignSpec spec = Read(R"({
    "experiments": [
      {"name": "steel", "map": "map.png", "plate_diameter": "10 mm"},
      {"name": "glass", "map": "map.png", "plate_diameter": "10 mm",
       "pairs": [{"between": ["powder", "plate"], "rolling_friction": 0.07}]}],
    "powder": {"material": {"density": 2500},
               "sizes": {"kind": "mono", "diameter": "400 um"}, "mass": "1.5 g"},
    "pairs": [{"between": ["powder", "plate"], "rolling_friction": 0.05}],
    "parameters": {"sliding_friction": {"min": 0.1, "max": 0.5},
                   "plate_pair_sliding_friction": {"min": 0.2, "max": 0.4},
                   "tube_pair_restitution": {"fixed": 0.3}}})");
  const auto space = SpaceOf(spec);
  ASSERT_EQ(space.Free().size(), 2u);
  const std::vector<double> values = space.ToNative(Eigen::Vector2d(0.5, 0.5));
  for (const int experiment : {0, 1}) {
    const rigs::Case c = CaseOf(spec, {.values = values, .experiment = experiment}, {});
    const engine::PairProperties plate = rigs::StatedWith(c.pairs, rigs::kFloor);
    EXPECT_DOUBLE_EQ(plate.sliding_friction.value(), 0.3);
    EXPECT_DOUBLE_EQ(plate.rolling_friction.value(), experiment == 0 ? 0.05 : 0.07);
    EXPECT_DOUBLE_EQ(rigs::StatedWith(c.pairs, rigs::kWalls).restitution.value(), 0.3);
    EXPECT_FALSE(c.materials.floor);
    EXPECT_DOUBLE_EQ(c.powder.material.sliding_friction, 0.3);
  }
}

TEST(Spec, EveryProblemIsReportedAtOnceWithItsPlace) {
  const std::string error = ErrorOf(R"({
  "experiment": {"map": "m.png", "plate_diameter": "10 mm"},
  "powder": {"material": {"density": 2500},
             "sizes": {"kind": "mono", "diameter": "400 um"}, "mass": "1.5 m"},
  "parameters": {"sliding_friction": {"min": 0.7, "max": 0.1},
                 "restitution": {"min": 0.5, "max": 1.5},
                 "surface_energi": {}},
  "objective": "saad",
  "budget": {"simulations": 0},
  "workers": -1
})");
  EXPECT_THAT(error, HasSubstr("powder.json:4:71: powder.mass: \"1.5 m\""));
  EXPECT_THAT(error, HasSubstr("powder.json:5:46: parameters.sliding_friction.min: is 0.7, must "
                               "be below max"));
  EXPECT_THAT(error, HasSubstr("parameters.restitution.max: is 1.5"));
  EXPECT_THAT(error, HasSubstr("parameters.surface_energi: is not known here; did you mean "
                               "\"surface_energy\"?"));
  EXPECT_THAT(error, HasSubstr("powder.json:8:16: objective: must be one of \"sad\", \"rmse\""));
  EXPECT_THAT(error, HasSubstr("budget.simulations: is 0, must be from 1 to 1000000"));
  EXPECT_THAT(error, HasSubstr("workers: is -1"));
}

TEST(Spec, WhatHasNoEffectOrCannotBeIsRefused) {
  EXPECT_THAT(ErrorOf(R"({
    "experiment": {"map": "m.png", "plate_diameter": "10 mm"},
    "powder": {"material": {"density": 2500},
               "sizes": {"kind": "mono", "diameter": "400 um"}, "mass": "1.5 g"},
    "parameters": {"surface_energy": {"min": 1e-6, "max": 1e-4}}})"),
              HasSubstr("has no effect without adhesion"));
  const auto funnel_error = [](const std::string& rim, const std::string& parameter) {
    return ErrorOf(R"({
      "experiments": [{"name": "funnel", "filling": {"kind": "pour"},
                       "rig": {"kind": "funnel_heap", "plate_diameter": "10 mm", "height": "10 mm",
                               "rim_height": ")" +
                   rim + R"("}, "angle_of_repose_1": {"value": "33 deg", "sd": "1 deg"}}],
      "powder": {"material": {"density": 2500},
                 "sizes": {"kind": "mono", "diameter": "400 um"}, "mass": "1.5 g"},
      "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}, ")" +
                   parameter + R"(": {"min": 0.1, "max": 0.9}}})");
  };
  EXPECT_EQ(funnel_error("1 mm", "tube_sliding_friction"), "");
  EXPECT_EQ(funnel_error("0 mm", "plate_pair_sliding_friction"), "");
  EXPECT_THAT(
      funnel_error("0 mm", "tube_sliding_friction"),
      HasSubstr("parameters.tube_sliding_friction: has no effect: no experiment's rig has a tube"));
  EXPECT_THAT(ErrorOf(With(R"("device": {"tube_length": "5 mm"})")),
              HasSubstr("device.tube_length: is 0.005 (\"5 mm\"), cannot hold the mass"));
  // 2000 kg/m³, the middle, fits; 1000 is twice as high.
  EXPECT_THAT(ErrorOf(With(R"("device": {"tube_length": "20 mm"},
      "parameters": {"density": {"min": 1000, "max": 3000}})")),
              HasSubstr("device.tube_length: is 0.02 (\"20 mm\"), cannot hold the mass"));
  EXPECT_THAT(ErrorOf(With(R"("noise": {"replicates": 1})")), HasSubstr("noise.replicates: is 1"));
}

TEST(Spec, ItsTextReadsBackToTheSameSpec) {
  const CampaignSpec spec = Read(With(R"("parameters": {
    "sliding_friction": {"min": 0.1, "max": 0.7}, "restitution": {"fixed": 0.6}})"));
  const std::string text = SpecText(spec);
  EXPECT_EQ(SpecText(ParseSpecText(text)), text);
  EXPECT_TRUE(ForbiddenChanges(text, text).empty());
}

std::vector<std::string> ChangesOf(const std::string& before, const std::string& after) {
  std::vector<std::string> texts;
  for (const base::JsonChange& change : ForbiddenChanges(before, after)) {
    texts.push_back(ChangeText(change));
  }
  return texts;
}

TEST(Spec, OnlyBudgetWorkersAndTheLikeMayChange) {
  const std::string before = SpecText(Read(kGood));
  EXPECT_TRUE(ForbiddenChanges(
                  before, SpecText(Read(With(R"("workers": 7, "budget": {"simulations": 9})"))))
                  .empty());
  const auto changes = ChangesOf(
      before, SpecText(Read(With(R"("seed": 2, "coarse_graining": {"scale_factor": 1.5})"))));
  EXPECT_THAT(changes, ::testing::UnorderedElementsAre("seed: 1 → 2",
                                                       "coarse_graining.scale_factor: 1 → 1.5"));
}

TEST(Spec, AChangeInOneOfSeveralExperimentsIsNamedByItsKey) {
  auto json = nlohmann::ordered_json::parse(SpecText(Read(kGood)));
  nlohmann::ordered_json first = json["experiment"];
  first["name"] = "first";
  first["device"] = json["device"];
  nlohmann::ordered_json second = first;
  second["name"] = "second";
  json.erase("experiment");
  json["experiments"] = {first, second};
  const std::string before = SpecText(ParseSpecText(json.dump()));
  json["experiments"][1]["device"]["lift_velocity"] = 0.03;
  const std::string after = SpecText(ParseSpecText(json.dump()));
  EXPECT_THAT(
      ChangesOf(before, after),
      ::testing::ElementsAre(::testing::StartsWith("experiments[1].device.lift_velocity: ")));
}

TEST(Spec, TheExamplesAreInOrder) {
  for (const char* name :
       {"demo/campaign.json", "demo/two_tests.json", "demo/three_tests.json",
        "ti6al4v/campaign.json", "al6061/campaign.json", "wet_sand/campaign.json",
        "film/campaign.json", "drum_mcc/campaign.json", "drum_mcc/campaign_true_grains.json"}) {
    const std::filesystem::path path = std::filesystem::path(TALUS_SOURCE_DIR) / "examples" / name;
    EXPECT_NO_THROW(ReadCampaignSpec(base::ReadJsonFile(path))) << path;
  }
}

// After a change, run with TALUS_UPDATE_SCHEMAS=1 and commit what it writes.
TEST(Spec, TheShippedSchemaIsTheParsers) {
  const std::string path = TALUS_SOURCE_DIR "/docs/campaign.schema.json";
  const std::string schema = base::FileSchema<CampaignSpec>("talus campaign").dump(2) + "\n";
  if (std::getenv("TALUS_UPDATE_SCHEMAS") != nullptr) base::WriteFileAtomically(path, schema);
  EXPECT_TRUE(base::ReadFile(path) == schema) << path << ": TALUS_UPDATE_SCHEMAS=1 makes it anew";
}

constexpr const char* kWeighed = R"({
  "experiments": [{"name": "drum", "angle": {"values": ["32 deg", "34 deg", "36 deg"]}, "weight": 3,
                   "rig": {"kind": "drum", "diameter": "40 mm", "width": "8 mm", "speed": "15 rpm",
                           "fill": 0.3}}],
  "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "2 mm"}},
  "coarse_graining": {"surface_energy_exponent": 2.5},
  "constraints": [{"terms": [{"parameter": "rolling_friction"},
                             {"parameter": "sliding_friction", "factor": -1}], "at_most": 0}],
  "parameters": {"sliding_friction": {"min": 0.1, "max": 0.5},
                 "rolling_friction": {"min": 0.0, "max": 0.5}}})";

TEST(Spec, ConstraintsBoundWhatIsSearched) {
  const optimizer::ParameterSpace space = SpaceOf(Read(kWeighed));
  ASSERT_EQ(space.constraints.size(), 1u);
  const optimizer::Domain domain = space.MakeDomain();
  EXPECT_TRUE(domain.Contains(Eigen::Vector2d(1, 0.9)));     // 0.45 below 0.5
  EXPECT_FALSE(domain.Contains(Eigen::Vector2d(0.5, 0.9)));  // 0.45 above 0.3
}

TEST(Spec, TrialsHaveItsExponentAndAnglesTheirErrorInDegrees) {
  const CampaignSpec spec = Read(kWeighed);
  EXPECT_EQ(TypicalCase(spec, 0, 1).coarse_graining.surface_energy_exponent, 2.5);
  const ScalarSpec angle = ScalarsOf(ExperimentsOf(spec)[0]).front();
  EXPECT_NEAR(angle.value, 34, 1e-9);
  EXPECT_NEAR(angle.standard_error, 2 / std::sqrt(3.0), 1e-9);
  EXPECT_EQ(angle.degrees, 2);
}

TEST(Targets, HaveTheErrorOfFewValuesAndTheWeightOfTheSpec) {
  const CampaignSpec spec = Read(kWeighed);
  journal::CampaignRecord record;
  record.experiments.resize(1);
  record.experiments[0].scalars = {
      {.name = "angle_deg", .value = 34, .standard_error = 1.2, .degrees = 2}};
  const std::vector<Reference> references{
      Reference({}, {.scalars = record.experiments[0].scalars})};
  const auto targets = TargetsOf(spec, record, references);
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_EQ(targets[0].weight, 3);
  ASSERT_EQ(targets[0].scalars.size(), 1u);
  EXPECT_EQ(targets[0].scalars[0].standard_error, record.experiments[0].scalars[0].NormalError());
  EXPECT_GT(targets[0].scalars[0].standard_error, 1.3);
  EXPECT_NEAR(targets[0].scalars[0].high, 90, 1e-9);
}

}  // namespace spec_test
}  // namespace talus::campaign
