// Cards along the posterior of a campaign with drawn heaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/analysis/card/card.h"
#include "experiments/analysis/card/card_deck.h"
#include "experiments/analysis/card/card_walls.h"
#include "experiments/rigs/case/case_text.h"
#include "tests/experiments/campaign_fixture.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::analysis {
namespace card_draws_test {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

using CardDrawsTest = campaign::CampaignFixture;

TEST_F(CardDrawsTest, AreFilesInEveryFormatWithTheirSetsAndWeights) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 24},
      "confirm": {"candidates": 1, "replicates": 2}, "workers": 1)");
  EXPECT_THROW(ReadDrawCards(folder, 5), base::ConfigError);  // no result yet
  campaign::RunFake(folder, {});
  Card recommended = ReadCard(folder);
  EXPECT_THAT(CardText(recommended, CardFormat::kTable), Not(HasSubstr("prior")));
  recommended.ranges[0].prior = "0.35 ± 0.05";
  EXPECT_THAT(CardText(recommended, CardFormat::kTable), HasSubstr(" (prior 0.35 ± 0.05)\n"));
  EXPECT_THAT(CardText(recommended, CardFormat::kJson), HasSubstr("\"prior\": \"0.35 ± 0.05\""));
  const std::vector<DrawCard> cards = ReadDrawCards(folder, 5);
  ASSERT_EQ(cards.size(), 5u);
  double sum = 0;
  for (const DrawCard& card : cards) sum += card.weight;
  EXPECT_NEAR(sum, 1, 1e-12);
  std::vector<CardFormat> all;
  for (const auto& [name, format] : base::Names<CardFormat>::kList) all.push_back(format);
  WriteDrawCards(cards, all, scratch_.path() / "cards");
  const auto json =
      nlohmann::json::parse(base::ReadFile(scratch_.path() / "cards/draw_0002_json.json"));
  EXPECT_EQ(json["materials"]["powder"]["sliding_friction"], cards[1].card.ranges[0].value);
  EXPECT_NE(cards[0].card.ranges[0].value, cards[1].card.ranges[0].value);
  EXPECT_EQ(json["sizes"][0]["volume_share"], 1);
  EXPECT_NEAR(json["sizes"][0]["diameter_m"].get<double>(), 4e-4, 1e-9);
  EXPECT_EQ(json["tests"][0]["name"], "heap");
  EXPECT_FALSE(json["warnings"].empty());  // few grains across such a plate
  const std::string lammps = base::ReadFile(scratch_.path() / "cards/draw_0005_lammps.in");
  EXPECT_THAT(lammps, HasSubstr("draw 5 of 5 of the posterior, weight"));
  EXPECT_THAT(lammps, HasSubstr("fix plate all wall/gran/region granular hertz/material"));
  int files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(scratch_.path() / "cards")) {
    ++files;
  }
  EXPECT_EQ(files, 5 * 7 + 2);  // draws.csv, and whose folder it is
}

// A case as it is was headed as a calibrated set.
TEST(DeckCard, OfACaseDoesNotCallItCalibrated) {
  const ScratchFolder scratch;
  rigs::Case rig_case;
  rig_case.powder.mass = 1e-3;
  rig_case.powder.sizes.kind = engine::SizeKind::kMono;
  rig_case.powder.sizes.diameter = 1e-3;
  base::WriteFileAtomically(scratch.path() / "case.json", rigs::CaseText(rig_case));
  const Card card = ReadCard(scratch.path() / "case.json");
  EXPECT_THAT(CardText(card, CardFormat::kLammps),
              HasSubstr("case.json, a case of talus as it is"));
  EXPECT_THAT(CardText(CardOf(rig_case), CardFormat::kLammps),
              HasSubstr(", calibrated with talus"));
}

// LAMMPS' conversions of our conventions were made a second time of values that its deck had taken.
TEST(DeckCard, HasThePlaceholdersAsTheyWentIntoTheDeck) {
  rigs::Case rig_case;
  rig_case.powder.material.sliding_friction = 0.3;
  rig_case.powder.material.surface_energy = 0.01;
  rig_case.coarse_graining.scale_factor = 2;
  Card card = CardOf(rig_case);
  card.ranges = {{.name = "sliding_friction", .unit = "", .value = 0.3, .low = 0.2, .high = 0.4}};
  trials::CommandOptions engine;
  engine.templates = "/a/deck";
  engine.command = {"lmp", "-in", "in.heap"};
  card.deck = DeckOf(engine, rig_case, {"sliding_friction", "surface_energy"});
  for (const auto& [name, format] : base::Names<CardFormat>::kList) {
    const std::string text = CardText(card, format);
    EXPECT_THAT(text, HasSubstr("lmp -in in.heap")) << name;
    EXPECT_THAT(text, HasSubstr("nothing is converted")) << name;
    EXPECT_THAT(text, testing::Not(HasSubstr("rolling"))) << name;
  }
  const std::string lammps = CardText(card, CardFormat::kLammps);
  EXPECT_THAT(lammps, HasSubstr("#   {{ sliding_friction }} = 0.3, 90 %: 0.2 ... 0.4\n"));
  EXPECT_THAT(lammps, HasSubstr("{{ surface_energy_used }} = 0.02, {{ scale_factor }} = 2"));
  const auto json = nlohmann::json::parse(CardText(card, CardFormat::kJson));
  EXPECT_EQ(json["placeholders"]["surface_energy"], "0.01");
  EXPECT_EQ(json["tests"][0]["device"]["plate_diameter"], rig_case.rig.lifted_tube.plate_diameter);
}

// A heap on a plate of its own, and powder tapped in a cylinder of another material that states its
// friction with the grains: the card has the walls of both, and each code gets them by their test.
TEST_F(CardDrawsTest, EveryTestOfACampaignHasItsOwnWalls) {
  const fs::path spec = campaign::WriteFakeSpec(scratch_.path() / "in", R"(, "workers": 1,
      "budget": {"simulations": 24}, "confirm": {"candidates": 0})");
  std::string text = base::ReadFile(spec);
  const std::string map =
      text.substr(text.find("\"map\""), text.find("\"powder\"") - text.find("\"map\""));
  text.replace(text.find("\"experiment\""), text.find("\"powder\"") - text.find("\"experiment\""),
               R"("experiments": [{"name": "heap", "device": {"plate_material":
                    {"sliding_friction": 0.8}}, )" +
                   map.substr(0, map.rfind(',')) + R"(,
      {"name": "taps", "rig": {"kind": "tapped_density", "diameter": "12 mm"},
       "filling": {"kind": "pour"}, "tapped_density": {"value": "1480 kg/m^3", "sd": "3 kg/m^3"},
       "device": {"tube_material": {"restitution": 0.4}},
       "pairs": [{"between": ["powder", "tube"], "sliding_friction": 0.25}]}], )");
  base::WriteFileAtomically(spec, text);
  const fs::path folder = scratch_.path() / "run";
  campaign::BeginCampaign(spec, folder);
  campaign::RunFake(folder, {});
  const Card card = ReadCard(folder);
  ASSERT_EQ(card.materials.size(), 3u);
  EXPECT_EQ(card.materials[1].name, "plate of heap");
  EXPECT_EQ(card.materials[1].material.sliding_friction, 0.8);
  EXPECT_EQ(card.materials[2].name, "tube of taps");
  EXPECT_EQ(card.materials[2].material.restitution, 0.4);
  EXPECT_EQ(ActingOn(card, 0, 2).sliding_friction, 0.25);
  EXPECT_EQ(ActingOn(card, 0, 1).sliding_friction, card.ranges[0].value);
  ASSERT_EQ(card.tests.size(), 2u);
  EXPECT_EQ(card.tests[0].tube, 0u);
  EXPECT_EQ(card.tests[0].plate, 1u);
  EXPECT_EQ(card.tests[1].tube, 2u);
  EXPECT_EQ(card.tests[1].plate, 0u);
  const std::string liggghts = CardText(card, CardFormat::kLiggghts);
  EXPECT_THAT(liggghts, HasSubstr("1 powder, 2 plate of heap, 3 tube of taps;"));
  EXPECT_THAT(liggghts, HasSubstr("# Walls of heap (a plate"));
  EXPECT_THAT(liggghts, HasSubstr("primitive type 2 zplane 0.0"));
  EXPECT_THAT(liggghts, HasSubstr("# Walls of taps: type 3, its floor: type 1\n"));
  const std::string lammps = CardText(card, CardFormat::kLammps);
  EXPECT_THAT(lammps, HasSubstr("# fix plate all wall/gran/region granular hertz/material"));
  EXPECT_THAT(lammps, HasSubstr("# walls of taps: fix tube2 all wall/gran/region granular"));
  EXPECT_THAT(
      CardText(card, CardFormat::kLethe),
      HasSubstr("# NOT INCLUDED: tube of taps. Lethe has one wall material: plate of heap."));
  EXPECT_THAT(CardText(card, CardFormat::kYade),
              HasSubstr("powder and tube of taps: sliding_friction = 0.25"));
  const auto json = nlohmann::json::parse(CardText(card, CardFormat::kJson));
  EXPECT_EQ(json["tests"][1]["tube_material"], "tube of taps");
}

// Tests that share a plate have one, under its plain name.
TEST(CardTests, SharedWallsAreGivenOnce) {
  rigs::Case rig_case;
  rig_case.powder.mass = 1e-3;
  rig_case.powder.sizes = {.kind = engine::SizeKind::kMono, .diameter = 1e-3};
  rig_case.materials.floor = rigs::WallMaterial{.sliding_friction = 0.8};
  Card card = CardOf(rig_case);
  AddTest(rig_case, "again", card);
  NameWalls(card);
  ASSERT_EQ(card.materials.size(), 2u);
  EXPECT_EQ(card.materials[1].name, "plate");
  EXPECT_EQ(card.tests[1].plate, 1u);
}

TEST(CardTests, NameTheRigThatTheSetComesFrom) {
  rigs::Case rig_case;
  rig_case.rig.kind = rigs::RigKind::kDrum;
  rig_case.powder.mass = 1e-3;
  rig_case.powder.sizes = {.kind = engine::SizeKind::kUniform, .min = 1e-3, .max = 2e-3};
  const Card card = CardOf(rig_case);
  const std::string text = CardText(card, CardFormat::kTable);
  EXPECT_THAT(text, HasSubstr("drum, drum: diameter 60 mm"));
  EXPECT_THAT(text, testing::Not(HasSubstr("lifted")));
  ASSERT_EQ(card.sizes.size(), 5u);
  EXPECT_GT(card.sizes[0].diameter, 1e-3);
  EXPECT_LT(card.sizes[4].diameter, 2e-3);
  // By number the finest class of equal volumes has the most grains.
  EXPECT_THAT(CardText(card, CardFormat::kLammps), HasSubstr("diam poly 5 "));
  EXPECT_THAT(CardText(card, CardFormat::kYade),
              HasSubstr("psdCumm=[0, 0.2, 0.2, 0.4, 0.4, 0.6, 0.6, 0.8, 0.8, 1]"));
}

}  // namespace card_draws_test
}  // namespace talus::analysis
