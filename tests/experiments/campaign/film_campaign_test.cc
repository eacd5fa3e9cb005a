// Campaigns on films of drawn heaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/text/number_text.h"
#include "experiments/journal/database.h"
#include "imaging/drawing/canvas.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/film_strip.h"
#include "tests/experiments/campaign_fixture.h"

namespace talus::campaign {
namespace film_campaign_test {

namespace fs = std::filesystem;

class FilmCampaign : public CampaignFixture {
 protected:
  // The folder of a campaign with a film of `num_pictures`, or with one picture and no film.
  fs::path BeginFilm(const std::string& name, int num_pictures, bool grows,
                     const std::string& more) const {
    const fs::path in = scratch_.path() / (name + "_in");
    fs::create_directories(in);
    const imaging::GrayImage strip =
        DrawFilm(kTrueSliding, kTrueRolling, 12345, num_pictures, grows);
    const imaging::Profile film{.image = strip,
                                .frame = imaging::StripOf(FakeFrame(), num_pictures)};
    std::string times, maps;
    for (int i = 0; i < num_pictures; ++i) {
      const std::string file = std::to_string(i) + ".png";
      imaging::WritePng(in / file, imaging::PictureOf(film, i).image);
      times += (i > 0 ? ", " : "") + std::to_string(0.01 * (i + 1));
      maps += (i > 0 ? R"(, {"map": ")" : R"({"map": ")") + file + "\"}";
    }
    const std::string images = num_pictures > 1 ? R"("film": [)" + maps + "]" : R"("map": "0.png")";
    std::ofstream(in / "spec.json") << R"({"experiments": [{"name": ")" << experiment_
                                    << R"(", "plate_diameter": "10 mm", )" << images << R"(,
        "rig": {"kind": "column_collapse", "length": "10 mm", "camera": {"times": [)"
                                    << times << R"(]}},
        "frame": {"width_px": 120, "height_px": 80, "pixel_size": "0.1 mm", "center_x_px": 60,
                  "baseline_px": 76, "plate_diameter": "10 mm"}}],
        "powder": {"material": {"density": 2500},
                   "sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g"},
        "parameters": {"sliding_friction": {"min": 0.1, "max": 0.8},
                       "rolling_friction": {"min": 0.05, "max": 0.5}}, "next": {"share": 0},
        "workers": 1)" << more << "}";
    BeginCampaign(in / "spec.json", scratch_.path() / name);
    return scratch_.path() / name;
  }
  std::string experiment_ = "column";
};

// What is written above a map that is `width` pixels wide.
std::vector<std::uint8_t> BandOf(const imaging::GrayImage& map) {
  constexpr int kHigh = 18;  // [px]
  return {map.pixels.begin(), map.pixels.begin() + kHigh * map.width};
}

constexpr const char* kSameSets = R"(, "strategy": {"kind": "sobol"},
    "budget": {"simulations": 24}, "confirm": {"candidates": 1, "ends": false, "replicates": 2})";

// Pictures of one run are no independent measurements: a film of three copies of a picture leaves
// the ranges that the picture leaves, where three experiments would leave some √3 of them. The
// modes are the same but for a factor √3, which goes through logarithms and iterations.
TEST_F(FilmCampaign, CopiesOfAPictureTellWhatThePictureTells) {
  const fs::path one = BeginFilm("one", 1, false, kSameSets);
  const fs::path three = BeginFilm("three", 3, false, kSameSets);
  EXPECT_EQ(RunFake(one, {}), CampaignEnd::kFinished);
  EXPECT_EQ(RunFake(three, {}), CampaignEnd::kFinished);
  const Answer single = Result(one);
  const Answer film = Result(three);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(film.parameters[k].Width() / single.parameters[k].Width(), 1, 0.1);
    EXPECT_NEAR(film.parameters[k].value, single.parameters[k].value,
                0.1 * (single.parameters[k].credible_high - single.parameters[k].credible_low));
  }
  const auto trials = Trials(one);
  const auto filmed = Trials(three);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(filmed[i].unit, trials[i].unit);
    EXPECT_NEAR(filmed[i].Metric("sad_mm2").value(), 3 * trials[i].Metric("sad_mm2").value(), 1e-9);
  }
}

// One drawn heap scatters by 0.01 in μ_r and by 0.3/20 in μ_t, and so does the experiment, which is
// one such heap; three times the two together.
TEST_F(FilmCampaign, ItFindsTheSetAndHasAMapOfEachPicture) {
  const fs::path folder = BeginFilm("film", 3, true, R"(, "budget": {"simulations": 24},
      "confirm": {"candidates": 1, "ends": false, "replicates": 2})");
  EXPECT_EQ(RunFake(folder, {.film_grows = true}), CampaignEnd::kFinished);
  const Answer result = Result(folder);
  EXPECT_NEAR(result.parameters[0].value, kTrueSliding, 0.06);
  EXPECT_NEAR(result.parameters[1].value, kTrueRolling, 0.06);
  ASSERT_EQ(result.remains.size(), 3U);
  double sad = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ResultRemains& remains = result.remains[i];
    EXPECT_EQ(remains.experiment, "column");
    EXPECT_EQ(remains.picture, static_cast<int>(i) + 1);
    EXPECT_EQ(remains.file, "remains/1_column_" + std::to_string(i + 1) + ".png");
    EXPECT_EQ(remains.num_trials, 2);
    EXPECT_GT(imaging::ReadGrayImage(folder / remains.file).width, 500);  // with axes and scale
    EXPECT_LT(remains.share.value(), 0.1);  // 3 % of its height is what a heap scatters by
    sad += remains.sad_mm2;
  }
  EXPECT_NEAR(sad, result.confirmed.at(0).experiments.at(0).profile_sad_mm2.value(), 1e-9);
}

TEST_F(FilmCampaign, AnInterruptedOneGoesOnWithTheSameBits) {
  const char* few = R"(, "budget": {"simulations": 16}, "confirm": {"candidates": 0})";
  const fs::path whole = BeginFilm("whole", 2, true, few);
  RunFake(whole, {.film_grows = true});
  const fs::path cut = scratch_.path() / "cut";
  fs::copy(whole, cut, fs::copy_options::recursive);
  journal::Database(journal::JournalPath(cut), journal::Database::Mode::kReadWrite)
      .Execute(
          "DELETE FROM profiles WHERE trial > 7; DELETE FROM metrics WHERE trial > 7;"
          "DELETE FROM points WHERE trial > 7; DELETE FROM trials WHERE id > 7");
  EXPECT_EQ(RunFake(cut, {.film_grows = true}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(cut), TrialTable(whole));
  EXPECT_EQ(base::ReadFile(cut / "posterior.csv"), base::ReadFile(whole / "posterior.csv"));
}

// The font of the pictures has ASCII only: "größer" was "gr????er".
TEST_F(FilmCampaign, AMapLeavesOutANameThatItsFontDoesNotHave) {
  experiment_ = "größer";
  const fs::path folder = BeginFilm("named", 2, true, kSameSets);
  EXPECT_EQ(RunFake(folder, {.film_grows = true}), CampaignEnd::kFinished);
  const ResultRemains remains = Result(folder).remains.at(0);
  EXPECT_EQ(remains.experiment, experiment_);
  const imaging::GrayImage map = imaging::ReadGrayImage(folder / remains.file);
  imaging::ColorImage band = imaging::MakeCanvas(map.width, map.height);
  imaging::DrawText(band, {.text = "picture 1 of 2: " + base::ShortNumber(remains.sad_mm2, 3) +
                                   " mm2, " + base::ShortNumber(100 * remains.share.value(), 2) +
                                   " % of the powder's area; mean of 2 simulations",
                           .at = {10, 9},
                           .size = 0.42});
  imaging::WritePng(scratch_.path() / "band.png", band);
  EXPECT_EQ(BandOf(map), BandOf(imaging::ReadGrayImage(scratch_.path() / "band.png")));
}

// The trials' folders hold the films, and campaign.json the experiment's.
TEST_F(FilmCampaign, AJournalThatIsLostIsMadeAnew) {
  const fs::path folder = BeginFilm("lost", 2, true, kSameSets);
  EXPECT_EQ(RunFake(folder, {.film_grows = true}), CampaignEnd::kFinished);
  const std::string table = TrialTable(folder);
  for (const char* suffix : {"", "-wal", "-shm"}) {
    fs::remove(folder / (std::string("journal.sqlite") + suffix));
  }
  EXPECT_EQ(RunFake(folder, {.film_grows = true}), CampaignEnd::kFinished);
  EXPECT_EQ(TrialTable(folder), table);
}

// One image has one map, of what the model predicts where nothing is confirmed.
using OnePicture = CampaignFixture;

TEST_F(OnePicture, WhatRemainsIsPredictedWhereNothingIsConfirmed) {
  const fs::path folder =
      Begin(R"(, "budget": {"simulations": 24}, "confirm": {"candidates": 0}, "workers": 1)");
  EXPECT_EQ(RunFake(folder, {}), CampaignEnd::kFinished);
  const Answer result = Result(folder);
  ASSERT_EQ(result.remains.size(), 1U);
  EXPECT_EQ(result.remains[0].file, "remains/1_heap.png");
  EXPECT_EQ(result.remains[0].num_trials, 0);
  EXPECT_TRUE(fs::exists(folder / result.remains[0].file));
  EXPECT_LT(result.remains[0].share.value(), 0.1);
}

}  // namespace film_campaign_test
}  // namespace talus::campaign
