// Cards along the posterior of a campaign with drawn heaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "experiments/analysis/card/card.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {
namespace card_draws_test {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

using CardDrawsTest = campaign::CampaignFixture;

TEST_F(CardDrawsTest, AreFilesInEveryFormatWithTheirSetsAndWeights) {
  const fs::path folder = Begin(R"(, "budget": {"simulations": 24},
      "confirm": {"candidates": 1, "replicates": 2}, "workers": 1)");
  EXPECT_THROW(ReadDrawCards(folder, 5), base::ConfigError);  // no result yet
  campaign::RunFake(folder, {});
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

TEST(CardTests, NameTheRigThatTheSetComesFrom) {
  rigs::Case rig_case;
  rig_case.rig.kind = rigs::RigKind::kDrum;
  rig_case.powder.mass = 1e-3;
  rig_case.powder.sizes = {.kind = engine::SizeKind::kUniform, .min = 1e-3, .max = 2e-3};
  const Card card = CardOf(rig_case);
  const std::string text = CardText(card, CardFormat::kTable);
  EXPECT_THAT(text, HasSubstr("drum, diameter 0.06"));
  EXPECT_THAT(text, testing::Not(HasSubstr("lifted")));
  ASSERT_EQ(card.sizes.size(), 5u);
  EXPECT_GT(card.sizes[0].diameter, 1e-3);
  EXPECT_LT(card.sizes[4].diameter, 2e-3);
  // By number the finest class of equal volumes has the most grains.
  EXPECT_THAT(CardText(card, CardFormat::kLammps), HasSubstr("diam poly 5 "));
  EXPECT_THAT(CardText(card, CardFormat::kYade), HasSubstr("psdCumm=[0.2, 0.4, 0.6, 0.8, 1]"));
}

}  // namespace card_draws_test
}  // namespace talus::analysis
