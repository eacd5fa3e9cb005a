// What was measured on a process that is predicted.
#include "experiments/analysis/predict/measured_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "base/json/json_writer.h"
#include "experiments/analysis/predict/prediction_runs.h"
#include "experiments/analysis/predict/prediction_text.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/formats/images/profile_file.h"
#include "imaging/heap/metrics.h"
#include "tests/error_in.h"
#include "tests/experiments/drawn_drum.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::analysis {
namespace measured_process_test {

using campaign::DrawDrum;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class MeasuredDrumTest : public ::testing::Test {
 protected:
  MeasuredDrumTest() {
    drum_.name = "10rpm";
    drum_.rig_case.rig.kind = rigs::RigKind::kDrum;
    drum_.rig_case.rig.drum.diameter = 0.084;
    imaging::WritePng(scratch_.path() / "right.png", DrawDrum(true));
    imaging::WritePng(scratch_.path() / "left.png", DrawDrum(false));
    imaging::WritePng(scratch_.path() / "hazy.png", DrawDrum(true, 16));
  }
  MeasuredProcess Read(const std::string& text) const {
    std::ofstream(scratch_.path() / "measured.json") << text;
    return ReadMeasured(scratch_.path() / "measured.json", drum_);
  }
  std::string ErrorOf(const std::string& text) const {
    return ErrorIn([&] { Read(text); });
  }

  ScratchFolder scratch_;
  PredictedCase drum_;
};

// The drum's circle was sought for a plate, since only a campaign's maps were read as drums.
TEST_F(MeasuredDrumTest, AMapOfADrumIsReadByItsCircle) {
  const auto profile = Read(R"({"map": "right.png"})").profile;
  ASSERT_TRUE(profile.has_value());
  EXPECT_EQ(profile->frame.plate_diameter, 0.084);
  EXPECT_NEAR(profile->frame.pixel_size, 0.042 / campaign::kDrumRadius,
              0.01 * profile->frame.pixel_size);
  ASSERT_TRUE(profile->frame.disc_diameter.has_value());
  // Powder on the left of the middle, light on the right, whichever way it turned.
  const auto turned = Read(R"({"map": "left.png", "turning": "counter-clockwise"})").profile;
  for (const imaging::GrayImage* image : {&profile->image, &turned->image}) {
    EXPECT_EQ(image->at(campaign::kDrumSide / 2 - 60, campaign::kDrumSide / 2), 0);
    EXPECT_EQ(image->at(campaign::kDrumSide / 2 + 60, campaign::kDrumSide / 2), 255);
  }
  EXPECT_THAT(ErrorOf(R"({"map": "left.png", "turning": "clockwise"})"),
              HasSubstr("turns the other way"));
}

TEST_F(MeasuredDrumTest, NumbersStandBesideTheMap) {
  const MeasuredProcess measured =
      Read(R"({"map": "right.png", "angle": {"value": "38 deg", "sd": "1 deg"}})");
  EXPECT_TRUE(measured.profile.has_value());
  ASSERT_EQ(measured.numbers.size(), 1u);
  EXPECT_EQ(measured.numbers[0].key, "angle");
  EXPECT_THAT(ErrorOf(R"({"runout": {"value": "1 cm", "sd": "1 mm"}})"),
              HasSubstr("runout: is not measured by the rig drum"));
  EXPECT_THAT(ErrorOf("{}"), HasSubstr("has no data"));
}

// A camera that shows powder where any picture has it needs the map made binary.
TEST_F(MeasuredDrumTest, PowderOfAnyPictureNeedsAThreshold) {
  drum_.rig_case.rig.camera = {.frames = 20, .interval = 0.01, .shows = rigs::Shown::kAny};
  EXPECT_THAT(ErrorOf(R"({"map": "hazy.png"})"), HasSubstr("threshold: is missing"));
  const auto any = Read(R"({"map": "hazy.png", "threshold": 0.9})").profile;
  const auto most = Read(R"({"map": "hazy.png", "threshold": 0.3})").profile;
  for (const std::uint8_t level : any->image.pixels) EXPECT_TRUE(level == 0 || level == 255);
  EXPECT_GT(imaging::Nebp(any->image), 1.1 * imaging::Nebp(most->image));
  imaging::WriteProfile(scratch_.path() / "profile.png", *most);
  EXPECT_TRUE(ReadMeasured(scratch_.path() / "profile.png", drum_).profile.has_value());
  imaging::Profile grey = *most;
  grey.image.at(0, 0) = 128;
  imaging::WriteProfile(scratch_.path() / "profile.png", grey);
  EXPECT_THAT(ErrorIn([&] { ReadMeasured(scratch_.path() / "profile.png", drum_); }),
              HasSubstr("give a JSON file with it as \"map\", and a \"threshold\""));
}

TEST_F(MeasuredDrumTest, AnImageOfAnotherTestIsRefused) {
  EXPECT_THAT(ErrorOf(R"({"map": "right.png", "plate_diameter": "60 mm"})"),
              HasSubstr("is scaled by a width of 60 mm (plate_diameter) where that of the case is "
                        "84 mm"));
  drum_.rig_case.rig.camera.emplace();
  drum_.rig_case.rig.camera->times = {0.1, 0.2};
  EXPECT_THAT(ErrorOf(R"({"map": "right.png"})"),
              HasSubstr("shows 1 picture where the case takes"));
}

// The run number r shows a bar of 100 + r pixels, each 1 mm².
imaging::GrayImage Bar(int length) {
  imaging::GrayImage image{
      .width = 1000, .height = 1, .pixels = std::vector<std::uint8_t>(1000, 255)};
  std::fill_n(image.pixels.begin(), length, std::uint8_t{0});
  return image;
}

// Beside a bar that is far longer.
Prediction BesideABar(int num_draws, int num_seeds) {
  const auto count = static_cast<std::size_t>(num_draws);
  PredictionRuns runs(
      std::vector<double>(count, 1),
      RunsOf({{.scale_factor = 1, .num_draws = num_draws, .num_seeds = num_seeds}}, count), 1);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    trials::TrialOutput output;
    output.profile = Bar(100 + static_cast<int>(r));
    runs.Add(r, output);
  }
  MeasuredProcess measured;
  measured.profile.emplace();
  measured.profile->image = Bar(900);
  measured.profile->frame.pixel_size = 1e-3;
  Prediction prediction;
  prediction.draws.resize(count);
  runs.Compare(measured, {}, prediction);
  return prediction;
}

// The largest of seven distances holds fewer than 90 % of further ones; nor do three draws stand
// for all sets.
TEST(MeasuredImages, AreNotJudgedByAFewRuns) {
  const auto image = [](int draws, int seeds) { return BesideABar(draws, seeds).image.value(); };
  EXPECT_EQ(image(1, 8).is_inside, false);
  EXPECT_EQ(image(4, 3).is_inside, false);
  EXPECT_EQ(image(4, 3).nearest_is_inside, false);
  EXPECT_GT(image(4, 3).sad_90_mm2, 1);
  for (const auto& [draws, seeds] : {std::pair(1, 1), {1, 7}, {7, 1}, {3, 3}}) {
    const MeasuredImage few = image(draws, seeds);
    EXPECT_GT(few.sad_mm2, 700);
    EXPECT_TRUE(std::isnan(few.sad_90_mm2));
    EXPECT_FALSE(few.is_inside.has_value());
    EXPECT_FALSE(base::ToJson(few).contains("is_inside"));
    EXPECT_TRUE(base::ToJson(few).at("sad_90_mm2").is_null());
  }
  // Two runs are equally far from their mean: seven draws with two tell seven distances.
  EXPECT_TRUE(image(7, 2).is_inside.has_value());
  EXPECT_FALSE(image(7, 2).nearest_is_inside.has_value());
  EXPECT_TRUE(image(8, 2).nearest_is_inside.has_value());
}

TEST(MeasuredImages, AreSaidNotToBeJudged) {
  const auto text = [](int draws, int seeds) {
    return PredictionText(BesideABar(draws, seeds), {});
  };
  EXPECT_THAT(text(1, 7), HasSubstr("tell how far others lie from it: it takes 8\n"));
  EXPECT_THAT(text(3, 3), HasSubstr("it takes 8, of 4 draws or more\n"));
  EXPECT_THAT(text(3, 3), testing::Not(HasSubstr("does not give it")));
  EXPECT_THAT(text(4, 3), HasSubstr("mm² of 90 % of single runs; nearest is draw 4"));
  EXPECT_THAT(text(4, 3), HasSubstr("and does not give it either"));
}

}  // namespace measured_process_test
}  // namespace talus::analysis
