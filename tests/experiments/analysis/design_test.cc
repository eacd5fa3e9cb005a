#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "base/files/file.h"
#include "base/json/json_schema.h"
#include "experiments/analysis/design/design_spec.h"
#include "experiments/analysis/design/design_text.h"
#include "experiments/analysis/design/rank_designs.h"
#include "tests/error_in.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::analysis {
namespace design_test {

using campaign::FakeEngine;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kPowder = R"(
  "powder": {"material": {"density": 2500},
             "sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g"},
  "coarse_graining": {"scale_factors": [2, 1]},
  "parameters": {"sliding_friction": {"min": 0.1, "max": 0.8},
                 "rolling_friction": {"min": 0.05, "max": 0.5}})";

// Heaps tell both frictions, a tapped density the rolling one.
constexpr const char* kCandidates = R"(, "candidates": [
  {"name": "heap", "frame": {"width_px": 120, "height_px": 80, "pixel_size": "0.1 mm",
    "center_x_px": 60, "baseline_px": 76, "plate_diameter": "10 mm"}},
  {"name": "tapped density", "rig": {"kind": "tapped_density", "diameter": "10 mm"},
   "tapped_density": {"sd": "8 kg/m^3"}}])";

class DesignTest : public campaign::CampaignFixture {
 protected:
  fs::path Write(const std::string& members) const {
    const fs::path path = scratch_.path() / "plan.json";
    std::ofstream(path) << "{" << members << "}";
    return path;
  }
  DesignTable Rank(const DesignSpec& design, const campaign::FakeEngineOptions& engine,
                   const std::map<std::string, std::string>& supposed = {}) const {
    const campaign::JointView view = ViewOf(design, scratch_.path());
    const campaign::CampaignParts parts{
        .runner = campaign::MakeDrawnRunner(view.spec, scratch_.path()),
        .engine = std::make_unique<FakeEngine>(engine)};
    if (supposed.empty()) return RankDesigns(view, design.candidates, parts);
    return RankDesigns(view, design.candidates, parts,
                       campaign::ReadSet(view.space, supposed, campaign::MayLack::kAny));
  }
  std::string ErrorOf(const std::string& members) const {
    return ErrorIn([&] { LoadDesignSpec(Write(members)); });
  }
};

TEST_F(DesignTest, RangesAreThoseThatTheMeasurementsLeave) {
  const DesignSpec design = LoadDesignSpec(Write(std::string(kPowder) + kCandidates));
  const DesignTable table = Rank(design, {});
  ASSERT_EQ(table.choices.size(), 2u)
      << table.tests.candidates[0].what << "; " << table.tests.candidates[1].what;
  ASSERT_EQ(table.choices[0].size(), 2u);
  EXPECT_THAT(table.choices[0][0].tests, ElementsAre(0u));  // the heap
  const optimizer::ExpectedLearning& tapped = table.choices[0][1].learning;
  // 350 kg/m³ per unit of μ_r; 8 kg/m³ of the balance and 4 √(1/3 + 1) of three runs and the
  // model's error are 0.0265 in μ_r, 0.059 of what is searched, √(1/0.38) times that with the
  // surrogate's: ± 1.9 of them, more with heavy tails and at most 1.6 times as much.
  EXPECT_GT(tapped.width[1], 3.4 * 0.096);
  EXPECT_LT(tapped.width[1], 1.6 * 3.8 * 0.096);
  EXPECT_GT(tapped.width[0], 0.85);  // of μ_t nothing
  const optimizer::ExpectedLearning& both = table.choices[1].at(0).learning;
  EXPECT_THAT(table.choices[1][0].tests, ElementsAre(0u, 1u));
  EXPECT_GT(both.bits, table.choices[0][0].learning.bits);
  EXPECT_LT(both.width[0], 0.3);
  const std::string text = DesignText(table, ViewOf(design, scratch_.path()), design.candidates);
  EXPECT_THAT(text, HasSubstr("heap + tapped density"));
  EXPECT_THAT(text,
              ContainsRegex("leave sliding_friction 0\\.[0-9]+ \\(0\\.[0-9]+ … 0\\.[0-9]+\\), "));
  const auto json = nlohmann::json::parse(DesignJson(table)).at("choices").back();
  const auto width = [&](const char* key) {
    return json.at(key).at("sliding_friction").get<double>();
  };
  EXPECT_LE(width("width_90_low"), width("width_90"));
  EXPECT_LT(width("width_90"), width("width_90_high"));
  EXPECT_THAT(text, HasSubstr("3 runs of 0.5 g"));
  EXPECT_THAT(text, HasSubstr("tapped density: diameter 10 mm"));
}

// N(0.4, 0.05): ± 1.95 sd are 0.28 of the 0.7 that is searched, of the other nothing is known.
TEST_F(DesignTest, WhatIsKnownBeforehandCounts) {
  std::string spec = std::string(kPowder) + kCandidates;
  const std::string range = "\"max\": 0.8";
  spec.insert(spec.find(range) + range.size(), R"(, "prior": {"mean": 0.4, "sd": 0.05})");
  const DesignTable table = Rank(LoadDesignSpec(Write(spec)), {});
  EXPECT_NEAR(table.tests.width[0], 0.28, 0.03);
  EXPECT_GT(table.tests.width[1], 0.85);
}

// Ranges of one powder differ by the chance of its measurement alone, those of any by the powder,
// too; bits are of all sets.
TEST_F(DesignTest, APowderThatIsSupposedLeavesRangesOfItsOwn) {
  const DesignSpec design = LoadDesignSpec(Write(std::string(kPowder) + kCandidates));
  const DesignTable any = Rank(design, {});
  const auto rank_supposing = [&](const std::map<std::string, std::string>& supposed) {
    return Rank(design, {.no_command = true}, supposed);
  };
  const DesignTable middle =
      rank_supposing({{"sliding_friction", "0.45"}, {"rolling_friction", "0.275"}});
  const DesignTable end =
      rank_supposing({{"sliding_friction", "0.8"}, {"rolling_friction", "0.5"}});
  const optimizer::ExpectedLearning& both = middle.choices[1].at(0).learning;
  EXPECT_EQ(both.bits, any.choices[1].at(0).learning.bits);
  EXPECT_LT(both.wide[0] - both.narrow[0],
            any.choices[1].at(0).learning.wide[0] - any.choices[1].at(0).learning.narrow[0]);
  // At the corner of what is searched half of a region is cut away in each direction.
  EXPECT_LT(end.choices[1].at(0).learning.width.sum(), 0.85 * both.width.sum());
  EXPECT_LT(end.choices[1].at(0).remaining, middle.choices[1].at(0).remaining);
  const DesignTable partly = rank_supposing({{"rolling_friction", "0.275"}});
  const campaign::JointView view = ViewOf(design, scratch_.path());
  EXPECT_THAT(
      DesignText(partly, view, design.candidates),
      ContainsRegex(
          "supposed: rolling_friction 0\\.275\nin order [^\n]*\none test\n +[0-9.]+ %  heap\n"));
  EXPECT_EQ(nlohmann::json::parse(DesignJson(partly)).at("supposed").dump(),
            R"({"rolling_friction":0.275})");
  EXPECT_FALSE(nlohmann::json::parse(DesignJson(any)).contains("supposed"));
}

TEST_F(DesignTest, SimulationsAreMadeOnce) {
  const DesignSpec design = LoadDesignSpec(Write(std::string(kPowder) + kCandidates));
  const DesignTable first = Rank(design, {});
  const DesignTable again = Rank(design, {.no_command = true});
  EXPECT_EQ(again.choices[1][0].learning.bits, first.choices[1][0].learning.bits);
  EXPECT_EQ(first.tests.candidates[0].num_made, 32);
}

// What a folder holds of a plan with another prior does not count.
TEST_F(DesignTest, SetsFollowFromThePriorAndNotFromWhatRanBefore) {
  const std::string wide = std::string(kPowder) + kCandidates;
  std::string narrow = wide;
  const std::string range = "\"max\": 0.8";
  narrow.insert(narrow.find(range) + range.size(), R"(, "prior": {"mean": 0.4, "sd": 0.02})");
  Rank(LoadDesignSpec(Write(narrow)), {});
  const DesignTable after = Rank(LoadDesignSpec(Write(wide)), {});
  fs::remove_all(scratch_.path() / "next");
  const DesignTable fresh = Rank(LoadDesignSpec(Write(wide)), {});
  EXPECT_EQ(after.choices[0][0].learning.bits, fresh.choices[0][0].learning.bits);
}

// 32 of the heap, and of the tapped density nothing, which the campaign does not have.
TEST_F(DesignTest, ACampaignThatBeginsLaterTakesThemOver) {
  Rank(LoadDesignSpec(Write(std::string(kPowder) + kCandidates)), {});
  const fs::path spec = campaign::WriteFakeSpec(
      scratch_.path() / "in", R"(, "coarse_graining": {"scale_factors": [2, 1]}, "workers": 1,
      "budget": {"simulations": 4}, "confirm": {"candidates": 0})");
  campaign::BeginOptions options{.reuse = {scratch_.path()}};
  options.engine = [] { return std::make_unique<FakeEngine>(campaign::FakeEngineOptions{}); };
  const fs::path folder = scratch_.path() / "campaign";
  campaign::BeginCampaign(spec, folder, options);
  EXPECT_EQ(campaign::RunFake(folder, {}), campaign::CampaignEnd::kFinished);
  const auto trials = Trials(folder);
  ASSERT_EQ(trials.size(), 36u);
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(trials[i].kind, journal::TrialKind::kReused);
    EXPECT_EQ(trials[i].scale_factor, 2);
  }
  // Nothing of a design of its own.
  for (std::size_t i = 32; i < 36; ++i) EXPECT_EQ(trials[i].kind, journal::TrialKind::kSearch);
  EXPECT_EQ(Result(folder).reused.at(0).from, scratch_.path() / "next/heap");
}

TEST_F(DesignTest, UsualTestsStandForThoseThatAreNotNamed) {
  const DesignSpec design = LoadDesignSpec(Write(kPowder));
  ASSERT_EQ(design.candidates.size(), 11u);
  EXPECT_EQ(design.candidates[0].name, "heap");
  EXPECT_EQ(design.candidates[1].name, "wide plate, 5 cm/s");
}

// The plan's tube is nothing that a drum would be refused for.
TEST_F(DesignTest, EveryUsualTestCanBeSimulatedWhereThePlanStatesATube) {
  const DesignSpec design =
      LoadDesignSpec(Write(std::string(kPowder) + R"(, "device": {"tube_inner_diameter": "9 mm",
        "plate_diameter": "12 mm", "lift_velocity": "2 cm/s"})"));
  const campaign::JointView view = ViewOf(design, scratch_.path());
  for (const TestCandidate& test : design.candidates) {
    EXPECT_EQ(WhyNot(view, test), "") << test.name;
  }
  EXPECT_DOUBLE_EQ(design.candidates[1].device->plate_diameter, 27e-3);
}

TEST_F(DesignTest, WhatCannotBeIsRefusedWithItsPlace) {
  const std::string spec = kPowder;
  EXPECT_THAT(ErrorOf(spec + R"(, "experiment": {"map": "m.png", "plate_diameter": "10 mm"})"),
              HasSubstr("experiment: is measured already"));
  EXPECT_THAT(ErrorOf(spec + R"(, "candidates": [{"name": "a b"}, {"name": "a-b"}])"),
              HasSubstr("candidates[1].name"));
  EXPECT_THAT(ErrorOf(spec + R"(, "candidates": [{"name": "a", "runs": 0}])"),
              HasSubstr("candidates[0].runs"));
  EXPECT_THAT(ErrorOf(spec + R"(, "candidate": [])"), HasSubstr("did you mean \"candidates\"?"));
  EXPECT_THAT(ErrorOf(R"("coarse_graining": {"scale_factor": 2})"), HasSubstr("powder"));
}

// After a change: TALUS_UPDATE_SCHEMAS=1 experiments_analysis_design_test.
TEST_F(DesignTest, ShippedSchemaIsTheParsers) {
  const fs::path path = TALUS_SOURCE_DIR "/docs/design.schema.json";
  const std::string schema = base::FileSchema<DesignSpec>("talus design").dump(2) + "\n";
  if (std::getenv("TALUS_UPDATE_SCHEMAS") != nullptr) base::WriteFileAtomically(path, schema);
  EXPECT_TRUE(base::ReadFile(path) == schema) << path << ": TALUS_UPDATE_SCHEMAS=1 makes it anew";
}

}  // namespace design_test
}  // namespace talus::analysis
